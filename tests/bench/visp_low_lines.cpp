#include "tests/bench/visp_low_lines.hpp"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/bench/flat_ground.hpp"
#include "tests/bench/undistortion.hpp"
#include "tests/bench/visp_tracked_line.hpp"

namespace hogline::bench {
namespace {

constexpr double slipped_px = 6.0;
constexpr double farthest_y_m = 12.0;
constexpr double tee_to_hog_m = 6.401;  // to the house-side edge, as in vision/geometry/sheet.hpp, which is C++20

PaintedLine across(double width_m) {
  return {"hog line, house side", {-width_m / 2.0, tee_to_hog_m}, {width_m / 2.0, tee_to_hog_m}};
}

PaintedLine along(double x_m) { return {"along", {x_m, 0.0}, {x_m, farthest_y_m}}; }

class VispLowLines final : public Method {
 public:
  VispLowLines(const Camera& camera, double width_m)
      : mount_(camera.mount),
        undistortion_(camera.intrinsics),
        flat_{undistortion_.matrix(), {camera.intrinsics.width_px, camera.intrinsics.height_px}},
        ground_(camera, undistortion_.matrix()),
        hog_(across(width_m)) {
    for (const double x : {0.0, -width_m / 2.0, width_m / 2.0})
      along_.push_back(std::make_unique<TrackedLine>(along(x)));
  }

  void start(const Frame& frame, const vision::Pose& eMc) override {
    double unused_s = 0.0;
    const vpImage<unsigned char>& picture = grey(frame.image, unused_s);
    cMe_ = eMc.inverse();
    hog_.start(picture, flat_, cMe_);
    for (const auto& line : along_) line->start(picture, flat_, cMe_);
  }

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const vpImage<unsigned char>& picture = grey(frame.image, undistort_s);
    follow(hog_, picture);
    for (const auto& line : along_) follow(*line, picture);
    const auto hog = hog_.tracked_line();
    if (!hog) return refused("the hog line is not tracked", undistort_s);
    const GroundLine h = ground_.line(*hog);

    // Direction by all lines, offset by those along.
    double slope_sum = h.slope_rad;
    double x_sum = 0.0;
    int lines = 0;
    for (const auto& line : along_) {
      const auto seen = line->tracked_line();
      if (!seen) continue;
      const GroundLine g = ground_.line(*seen);
      slope_sum += g.slope_rad;
      x_sum += line->painted().begin.x() - g.intercept_m;
      ++lines;
    }
    if (lines == 0) return refused("no line along the sheet is tracked", undistort_s);
    Look look;
    look.ok = true;
    look.undistort_s = undistort_s;
    look.body.x_m = x_sum / lines;
    look.body.y_m = tee_to_hog_m - h.intercept_m;
    look.body.yaw_rad = -slope_sum / (lines + 1);
    cMe_ = (vision::eMb(look.body) * vision::bMc(mount_)).inverse();
    restart_what_slipped(picture);
    return look;
  }

 private:
  const vpImage<unsigned char>& grey(const cv::Mat& image, double& undistort_s) {
    cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
    const cv::Mat& flat = undistortion_.apply(grey_, undistort_s);
    picture_.init(flat.data, static_cast<unsigned>(flat.rows), static_cast<unsigned>(flat.cols), false);
    return picture_;
  }

  void follow(TrackedLine& line, const vpImage<unsigned char>& picture) const {
    if (line.tracked()) line.track(picture);
    if (!line.tracked()) line.start(picture, flat_, cMe_);
  }

  void restart_what_slipped(const vpImage<unsigned char>& picture) {
    for (const auto& line : along_) {
      if (line->distance(flat_, cMe_) > slipped_px) line->start(picture, flat_, cMe_);
    }
  }

  vision::Mount mount_;
  Undistortion undistortion_;
  FlatCamera flat_;
  FlatGround ground_;
  cv::Mat grey_;
  vpImage<unsigned char> picture_;  // a view of the undistorted grey picture
  TrackedLine hog_;
  std::vector<std::unique_ptr<TrackedLine>> along_;
  vision::Pose cMe_ = vision::Pose::Identity();
};

}  // namespace

std::unique_ptr<Method> make_visp_low_lines(const Camera& camera, double sheet_width_m) {
  return std::make_unique<VispLowLines>(camera, sheet_width_m);
}

}  // namespace hogline::bench
