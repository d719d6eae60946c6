#include "vision/plain/line_low_view.hpp"

#include <vector>

#include "vision/plain/flat_ground.hpp"
#include "vision/plain/tracked_line.hpp"

namespace hogline::vision::plain {
namespace {

constexpr double slipped_px = 6.0;
constexpr double farthest_y_m = 12.0;
constexpr double tee_to_hog_m = 6.401;  // to the house-side edge, as in vision/geometry/sheet.hpp, which is C++20

PaintedLine across(double width_m) {
  return {"hog line, house side", {-width_m / 2.0, tee_to_hog_m}, {width_m / 2.0, tee_to_hog_m}};
}

PaintedLine along(double x_m) { return {"along", {x_m, 0.0}, {x_m, farthest_y_m}}; }

LineLook unseen(std::string reason) {
  LineLook look;
  look.reason = std::move(reason);
  return look;
}

}  // namespace

struct LineLowView::Impl {
  Impl(const Intrinsics& k, const Mount& mount_in, double width_m)
      : mount(mount_in),
        flat{cv::Matx33d(k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0), {k.width_px, k.height_px}},
        ground(mount_in, flat.K),
        hog(across(width_m)) {
    for (const double x : {0.0, -width_m / 2.0, width_m / 2.0})
      sides.push_back(std::make_unique<TrackedLine>(along(x)));
  }

  const vpImage<unsigned char>& view(const cv::Mat& grey) {
    picture.init(grey.data, static_cast<unsigned>(grey.rows), static_cast<unsigned>(grey.cols), false);
    return picture;
  }
  void follow(TrackedLine& line) const {
    if (line.tracked()) line.track(picture);
    if (!line.tracked()) line.start(picture, flat, cMe);
  }
  double distance_per_px(double ahead_m) const {
    const auto here = ground.pixel({0.0, ahead_m});
    if (!here) return 0.0;
    const auto next = ground.ground(*here - Eigen::Vector2d(0.0, 1.0));
    return next ? std::abs(next->y() - ahead_m) : 0.0;
  }

  Mount mount;
  FlatCamera flat;
  FlatGround ground;
  vpImage<unsigned char> picture;  // a view of the undistorted grey picture
  TrackedLine hog;
  std::vector<std::unique_ptr<TrackedLine>> sides;
  Pose cMe = Pose::Identity();
};

LineLowView::LineLowView(const Intrinsics& intrinsics, const Mount& mount, double sheet_width_m)
    : impl_(std::make_unique<Impl>(intrinsics, mount, sheet_width_m)) {}
LineLowView::~LineLowView() = default;

void LineLowView::start(const cv::Mat& flat_grey, const Pose& eMc) {
  Impl& i = *impl_;
  i.view(flat_grey);
  i.cMe = eMc.inverse();
  i.hog.start(i.picture, i.flat, i.cMe);
  for (const auto& line : i.sides) line->start(i.picture, i.flat, i.cMe);
}

LineLook LineLowView::look(const cv::Mat& flat_grey) {
  Impl& i = *impl_;
  i.view(flat_grey);
  i.follow(i.hog);
  for (const auto& line : i.sides) i.follow(*line);
  const auto hog = i.hog.tracked_line();
  if (!hog) return unseen("the hog line is not tracked");
  const GroundLine h = i.ground.line(*hog);

  // Direction by all lines, offset by those along.
  double slope_sum = h.slope_rad;
  double x_sum = 0.0;
  int lines = 0;
  for (const auto& line : i.sides) {
    const auto seen = line->tracked_line();
    if (!seen) continue;
    const GroundLine g = i.ground.line(*seen);
    slope_sum += g.slope_rad;
    x_sum += line->painted().begin.x() - g.intercept_m;
    ++lines;
  }
  if (lines == 0) return unseen("no line along the sheet is tracked");
  LineLook look;
  look.ok = true;
  look.body.x_m = x_sum / lines;
  look.body.y_m = tee_to_hog_m - h.intercept_m;
  look.body.yaw_rad = -slope_sum / (lines + 1);
  look.distance_per_px_m = i.distance_per_px(h.intercept_m);
  i.cMe = (eMb(look.body) * bMc(i.mount)).inverse();
  for (const auto& line : i.sides) {
    if (line->distance(i.flat, i.cMe) > slipped_px) line->start(i.picture, i.flat, i.cMe);
  }
  return look;
}

}  // namespace hogline::vision::plain
