// A picture of another camera is refused with what is wrong with it.
#include "vision/picture/picture_shape.hpp"

#include <gtest/gtest.h>

namespace hogline::vision {
namespace {

TEST(PictureShape, SaysWhatIsWrong) {
  Intrinsics camera;
  camera.width_px = 64;
  camera.height_px = 48;
  struct Case {
    const char* what;
    cv::Mat picture;
    const char* fault;
  };
  const Case cases[] = {
      {"nothing", {}, "the picture is empty"},
      {"grey", cv::Mat(48, 64, CV_8UC1), "the picture is not 8 bits a channel in three colours"},
      {"16 bits", cv::Mat(48, 64, CV_16UC3), "the picture is not 8 bits a channel in three colours"},
      {"on its side", cv::Mat(64, 48, CV_8UC3), "the picture is 48x64, the rig's camera 64x48"},
      {"a row short", cv::Mat(47, 64, CV_8UC3), "the picture is 64x47, the rig's camera 64x48"},
      {"as it should be", cv::Mat(48, 64, CV_8UC3), ""},
  };
  for (const Case& one : cases) EXPECT_EQ(shape_fault(one.picture, camera), one.fault) << one.what;
}

}  // namespace
}  // namespace hogline::vision
