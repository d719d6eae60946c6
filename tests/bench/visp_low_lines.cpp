#include "tests/bench/visp_low_lines.hpp"

#include <opencv2/imgproc.hpp>

#include "tests/bench/undistortion.hpp"
#include "vision/plain/line_low_view.hpp"

namespace hogline::bench {
namespace {

class VispLowLines final : public Method {
 public:
  VispLowLines(const Camera& camera, double width_m)
      : undistortion_(camera.intrinsics), lines_(camera.intrinsics, camera.mount, width_m) {}

  void start(const Frame& frame, const vision::Pose& eMc) override {
    double unused_s = 0.0;
    lines_.start(flat_grey(frame.image, unused_s), eMc);
  }

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const vision::plain::LineLook seen = lines_.look(flat_grey(frame.image, undistort_s));
    if (!seen.ok) return refused(seen.reason, undistort_s);
    Look look;
    look.ok = true;
    look.undistort_s = undistort_s;
    look.body = seen.body;
    return look;
  }

 private:
  const cv::Mat& flat_grey(const cv::Mat& image, double& undistort_s) {
    cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
    return undistortion_.apply(grey_, undistort_s);
  }

  Undistortion undistortion_;
  vision::plain::LineLowView lines_;
  cv::Mat grey_;
};

}  // namespace

std::unique_ptr<Method> make_visp_low_lines(const Camera& camera, double sheet_width_m) {
  return std::make_unique<VispLowLines>(camera, sheet_width_m);
}

}  // namespace hogline::bench
