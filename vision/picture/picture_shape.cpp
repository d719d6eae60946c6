#include "vision/picture/picture_shape.hpp"

namespace hogline::vision {

std::string shape_fault(const cv::Mat& picture, const Intrinsics& camera) {
  const auto in_words = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
  if (picture.empty()) return "the picture is empty";
  if (picture.type() != CV_8UC3) return "the picture is not 8 bits a channel in three colours";
  if (picture.cols != camera.width_px || picture.rows != camera.height_px) {
    return "the picture is " + in_words(picture.cols, picture.rows) + ", the rig's camera " +
           in_words(camera.width_px, camera.height_px);
  }
  return {};
}

}  // namespace hogline::vision
