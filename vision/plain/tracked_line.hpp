// One painted line followed by ViSP's vpMeLine in an undistorted picture. C++17, as ViSP 3.5's headers want it.
#pragma once

#include <visp3/core/vpException.h>
#include <visp3/me/vpMeLine.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <opencv2/core/matx.hpp>
#include <optional>
#include <utility>

#include "vision/geometry/pose.hpp"
#include "vision/plain/painted_line.hpp"

namespace hogline::vision::plain {

inline constexpr int margin_px = 20;  // ViSP's sites need their range and mask inside the picture

// As in ViSP's tutorial on moving edges, with a threshold for thin lines. Tried as well: range 12, threshold 20000,
// half a pixel taken off for vpMeSite's truncation (which helps visp_model), vpPose's robust virtual visual servoing.
// This is the best of them.
inline vpMe moving_edges(double step_px) {
  vpMe me;
  me.setMaskSize(5);
  me.setMaskNumber(180);
  me.setRange(8);
  me.setThreshold(8000);
  me.setMu1(0.5);
  me.setMu2(0.5);
  me.setSampleStep(step_px);
  return me;
}

struct FlatCamera {
  cv::Matx33d K;
  cv::Size size;

  std::optional<Eigen::Vector2d> pixel(const Pose& cMe, const Eigen::Vector2d& e) const {
    const Eigen::Vector3d c = cMe * Eigen::Vector3d(e.x(), e.y(), 0.0);
    if (c.z() < 0.2) return std::nullopt;
    return Eigen::Vector2d(K(0, 0) * c.x() / c.z() + K(0, 2), K(1, 1) * c.y() / c.z() + K(1, 2));
  }
  bool shows(const Eigen::Vector2d& p) const {
    return p.x() > margin_px && p.y() > margin_px && p.x() < size.width - margin_px && p.y() < size.height - margin_px;
  }
};

// The part of a painted line that the picture shows, longest run of 5 cm steps.
struct Visible {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

inline std::optional<Visible> visible_part(const FlatCamera& camera, const Pose& cMe, const PaintedLine& line) {
  const int steps = static_cast<int>((line.end - line.begin).norm() / 0.05);
  std::optional<Visible> part;
  for (int i = 0; i <= steps; ++i) {
    const auto p = camera.pixel(cMe, line.begin + (line.end - line.begin) * i / steps);
    if (!p || !camera.shows(*p)) {
      if (part) break;
      continue;
    }
    if (!part) part = Visible{*p, *p};
    part->b = *p;
  }
  if (!part || (part->b - part->a).norm() < 60.0) return std::nullopt;
  return part;
}

inline vpImagePoint image_point(const Eigen::Vector2d& p) { return vpImagePoint(p.y(), p.x()); }

// A line that is tracked while it is seen, and started anew from the last pose when it was lost.
class TrackedLine {
 public:
  explicit TrackedLine(PaintedLine line) : line_(std::move(line)), me_(moving_edges(10.0)) {}

  const PaintedLine& painted() const { return line_; }

  void start(const vpImage<unsigned char>& picture, const FlatCamera& camera, const Pose& cMe) {
    tracker_.reset();
    const auto part = visible_part(camera, cMe, line_);
    if (!part) return;
    tracker_ = std::make_unique<vpMeLine>();
    tracker_->setMe(&me_);
    try {
      tracker_->initTracking(picture, image_point(part->a), image_point(part->b));
    } catch (const vpException&) {
      tracker_.reset();
    }
  }

  void track(const vpImage<unsigned char>& picture) {
    if (!tracker_) return;
    try {
      tracker_->track(picture);
    } catch (const vpException&) {
      tracker_.reset();  // after "not enough points" every later call throws as well
    }
  }

  bool tracked() const { return tracked_line().has_value(); }

  // From where the pose has the line's ends in the picture; 0 where it is not tracked or not in view.
  double distance(const FlatCamera& camera, const Pose& cMe) const {
    const auto line = tracked_line();
    const auto part = visible_part(camera, cMe, line_);
    if (!line || !part) return 0.0;
    const double norm = line->head<2>().norm();
    return std::max(std::abs(line->dot(part->a.homogeneous())), std::abs(line->dot(part->b.homogeneous()))) / norm;
  }

  // Homogeneous, in (u, v).
  std::optional<Eigen::Vector3d> tracked_line() const {
    if (!tracker_) return std::nullopt;
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    tracker_->getEquationParam(a, b, c);  // a i + b j + c = 0
    const Eigen::Vector3d line(b, a, c);
    if (!line.allFinite() || line.head<2>().norm() < 1e-12) return std::nullopt;
    return line;
  }

 private:
  PaintedLine line_;
  vpMe me_;  // one for each tracker, which changes it, and longer-lived
  std::unique_ptr<vpMeLine> tracker_;
};

}  // namespace hogline::vision::plain
