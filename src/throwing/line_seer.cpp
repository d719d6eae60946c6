#include "src/throwing/line_seer.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

// Moving edges know nothing of how sure they are. What a site's whole pixel and a mount that is a few hundredths of a
// degree off leave: a pixel of the hog line's place, and of the sidelines' along two metres.
constexpr double site_px = 1.0;
constexpr double least_distance_sigma_m = 0.002;
constexpr double yaw_sigma_rad = 0.1 * std::numbers::pi / 180.0;
constexpr double lateral_sigma_m = 0.01;

SheetPosePercept unseen(Stamp stamp, std::string reason) {
  SheetPosePercept percept;
  percept.reason = std::move(reason);
  percept.stamp = stamp;
  return percept;
}

}  // namespace

SheetPosePercept LineSeer::low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) {
  if (!hint.body || !hint.sheet_width_m) return unseen(frame.stamp, "where to begin is not known");
  if (!lines_) {
    undistortion_.emplace(low_setup_.intrinsics);
    lines_.emplace(low_setup_.intrinsics, low_setup_.mount, *hint.sheet_width_m);
  }
  cv::Mat grey;
  cv::cvtColor(frame.bgr, grey, cv::COLOR_BGR2GRAY);
  const cv::Mat& flat = undistortion_->apply(grey);
  if (!tracking_) lines_->start(flat, vision::eMb(*hint.body) * vision::bMc(low_setup_.mount));
  const vision::plain::LineLook look = lines_->look(flat);
  tracking_ = look.ok;
  if (!look.ok) return unseen(frame.stamp, look.reason);

  SheetPosePercept percept;
  percept.stamp = frame.stamp;
  percept.body = look.body;
  percept.hog_distance_m = vision::rules::tee_to_hog_m - look.body.y_m;
  const bool sane = std::isfinite(look.body.x_m) && std::isfinite(look.body.y_m) && std::isfinite(look.body.yaw_rad) &&
                    percept.hog_distance_m > 0.0 && look.distance_per_px_m > 0.0;
  if (!sane) {
    tracking_ = false;
    return unseen(frame.stamp, "the lines do not lie on the ice ahead");
  }
  percept.ok = true;
  percept.hog_distance_sigma_m = std::hypot(site_px * look.distance_per_px_m, least_distance_sigma_m);
  percept.sigma = {lateral_sigma_m, percept.hog_distance_sigma_m, yaw_sigma_rad};
  percept.sheet_width_m = *hint.sheet_width_m;
  percept.eMc = vision::row_major(vision::eMb(look.body) * vision::bMc(low_setup_.mount));
  percept.features = {"tracked"};
  return percept;
}

}  // namespace hogline
