#include "tests/bench/visp_lines.hpp"

#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>
#include <visp3/me/vpMeEllipse.h>
#include <visp3/vision/vpPose.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "tests/bench/undistortion.hpp"
#include "tests/bench/visp_pose.hpp"
#include "vision/plain/tracked_line.hpp"

namespace hogline::bench {
namespace {

using vision::plain::FlatCamera;
using vision::plain::image_point;
using vision::plain::moving_edges;
using vision::plain::TrackedLine;

constexpr double slipped_px = 4.0;
constexpr double pi = 3.14159265358979323846;

class TrackedRing {
 public:
  explicit TrackedRing(double radius_m) : radius_m_(radius_m), me_(moving_edges(10.0)) {}

  double radius_m() const { return radius_m_; }
  bool tracked() const { return tracker_ != nullptr; }

  void start(const vpImage<unsigned char>& picture, const FlatCamera& camera, const vision::Pose& cMe) {
    tracker_.reset();
    // The longest arc in the picture, counter-clockwise. ViSP wants at least two thirds of an ellipse.
    constexpr int n = 72;
    std::vector<vpImagePoint> arc;
    std::vector<vpImagePoint> longest;
    for (int i = 0; i < 2 * n && longest.size() < n; ++i) {
      const double angle = 2.0 * pi * i / n;
      const auto p = camera.pixel(cMe, radius_m_ * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      if (p && camera.shows(*p)) {
        arc.push_back(image_point(*p));
        if (arc.size() > longest.size()) longest = arc;
      } else {
        arc.clear();
      }
    }
    if (longest.size() < 2 * n / 3) return;
    const bool whole = longest.size() >= n;
    tracker_ = std::make_unique<vpMeEllipse>();
    tracker_->setMe(&me_);
    try {
      tracker_->initTracking(picture, longest, !whole);
    } catch (const vpException&) {
      tracker_.reset();
    }
  }

  void track(const vpImage<unsigned char>& picture) {
    if (!tracker_) return;
    try {
      tracker_->track(picture);
    } catch (const vpException&) {
      tracker_.reset();
    }
  }

  Eigen::Matrix3d conic() const {
    const vpColVector n = tracker_->get_nij();  // n20, n11, n02; see vpMeEllipse's documentation
    const double u = tracker_->getCenter().get_u();
    const double v = tracker_->getCenter().get_v();
    const double k3 = n[1] * v - n[2] * u;
    const double k4 = n[1] * u - n[0] * v;
    const double k5 = n[2] * u * u + n[0] * v * v - 2.0 * n[1] * u * v + 4.0 * (n[1] * n[1] - n[0] * n[2]);
    Eigen::Matrix3d C;
    C << n[2], -n[1], k3, -n[1], n[0], k4, k3, k4, k5;
    return C;
  }

 private:
  double radius_m_;
  vpMe me_;
  std::unique_ptr<vpMeEllipse> tracker_;
};

struct Crossing {
  Eigen::Vector2d e;
  Eigen::Vector2d pixel;
};

// Where the line cuts the conic, in the order along `forward`.
std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> cut(const Eigen::Matrix3d& conic,
                                                               const Eigen::Vector3d& line,
                                                               const Eigen::Vector2d& forward) {
  const Eigen::Vector2d normal = line.head<2>() / line.head<2>().norm();
  Eigen::Vector2d along(-normal.y(), normal.x());
  if (along.dot(forward) < 0.0) along = -along;
  const Eigen::Vector2d foot = -line.z() / line.head<2>().norm() * normal;
  const Eigen::Vector3d p(foot.x(), foot.y(), 1.0);
  const Eigen::Vector3d d(along.x(), along.y(), 0.0);
  const double qa = d.dot(conic * d);
  const double qb = d.dot(conic * p);
  const double discriminant = qb * qb - qa * p.dot(conic * p);
  if (!(discriminant > 0.0) || !(std::abs(qa) > 1e-15)) return std::nullopt;
  const double root = std::sqrt(discriminant) / std::abs(qa);
  const double middle = -qb / qa;
  return std::pair(Eigen::Vector2d(foot + (middle - root) * along), Eigen::Vector2d(foot + (middle + root) * along));
}

class VispLines final : public Method {
 public:
  VispLines(const Camera& camera, const CrossingLines& lines)
      : mount_(camera.mount),
        undistortion_(camera.intrinsics),
        flat_{undistortion_.matrix(), {camera.intrinsics.width_px, camera.intrinsics.height_px}} {
    // vpMe is not to be moved while a tracker holds it: the vectors are filled once.
    for (const PaintedLine& line : lines.across) across_.push_back(std::make_unique<TrackedLine>(line));
    for (const PaintedLine& line : lines.along) along_.push_back(std::make_unique<TrackedLine>(line));
    if (lines.ring_radius_m > 0.0) ring_ = std::make_unique<TrackedRing>(lines.ring_radius_m);
  }

  void start(const Frame& frame, const vision::Pose& eMc) override {
    double unused_s = 0.0;
    const vpImage<unsigned char>& picture = grey(frame.image, unused_s);
    cMe_ = eMc.inverse();
    for (auto* lines : {&across_, &along_}) {
      for (const auto& line : *lines) line->start(picture, flat_, cMe_);
    }
    if (ring_) ring_->start(picture, flat_, cMe_);
  }

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const vpImage<unsigned char>& picture = grey(frame.image, undistort_s);
    follow(picture);
    const std::vector<Crossing> points = crossings();
    if (points.size() < 4) return refused("fewer than four crossings are tracked", undistort_s);
    const auto cMe = pose_of(points);
    if (!cMe) return refused("vpPose finds no pose", undistort_s);
    cMe_ = *cMe;
    restart_what_slipped(picture);
    return {true, {}, vision::planar_body(cMe_.inverse(), mount_), undistort_s};
  }

 private:
  const vpImage<unsigned char>& grey(const cv::Mat& image, double& undistort_s) {
    cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
    const cv::Mat& flat = undistortion_.apply(grey_, undistort_s);
    picture_.init(flat.data, static_cast<unsigned>(flat.rows), static_cast<unsigned>(flat.cols), false);
    return picture_;
  }

  void follow(const vpImage<unsigned char>& picture) {
    for (auto* lines : {&across_, &along_}) {
      for (const auto& line : *lines) {
        if (line->tracked()) line->track(picture);
        if (!line->tracked()) line->start(picture, flat_, cMe_);
      }
    }
    if (!ring_) return;
    if (ring_->tracked()) ring_->track(picture);
    if (!ring_->tracked()) ring_->start(picture, flat_, cMe_);
  }

  // A line that went over to a neighbouring one, or slid along the ring, is started again where the pose has it.
  void restart_what_slipped(const vpImage<unsigned char>& picture) {
    for (auto* lines : {&across_, &along_}) {
      for (const auto& line : *lines) {
        if (line->distance(flat_, cMe_) > slipped_px) line->start(picture, flat_, cMe_);
      }
    }
  }

  std::vector<Crossing> crossings() const {
    std::vector<Crossing> points;
    const auto add = [&](const Eigen::Vector2d& e, const Eigen::Vector2d& pixel) {
      if (pixel.allFinite() && flat_.shows(pixel)) points.push_back({e, pixel});
    };
    for (const auto& a : across_) {
      const auto line_a = a->tracked_line();
      if (!line_a) continue;
      for (const auto& b : along_) {
        const auto line_b = b->tracked_line();
        if (!line_b) continue;
        const Eigen::Vector3d x = line_a->cross(*line_b);
        add({b->painted().begin.x(), a->painted().begin.y()}, x.head<2>() / x.z());
      }
    }
    if (!ring_ || !ring_->tracked()) return points;
    const Eigen::Matrix3d conic = ring_->conic();
    if (!conic.allFinite()) return points;
    const double r = ring_->radius_m();
    for (const auto& a : across_) {  // the tee line, from left to right
      const auto line = a->tracked_line();
      if (!line || std::abs(a->painted().begin.y()) > 1e-6) continue;
      const auto ends = cut(conic, *line, {1.0, 0.0});
      if (!ends) continue;
      add({-r, 0.0}, ends->first);
      add({r, 0.0}, ends->second);
    }
    for (const auto& b : along_) {  // the centre line, away from the robot
      const auto line = b->tracked_line();
      if (!line || std::abs(b->painted().begin.x()) > 1e-6) continue;
      const auto ends = cut(conic, *line, {0.0, -1.0});
      if (!ends) continue;
      add({0.0, -r}, ends->first);
      add({0.0, r}, ends->second);
    }
    return points;
  }

  // ViSP's own advice: both linear methods, the one with the lower residual, then virtual visual servoing.
  std::optional<vision::Pose> pose_of(const std::vector<Crossing>& points) const {
    vpPose pose;
    for (const Crossing& c : points) {
      vpPoint point(c.e.x(), c.e.y(), 0.0);
      point.set_x((c.pixel.x() - flat_.K(0, 2)) / flat_.K(0, 0));
      point.set_y((c.pixel.y() - flat_.K(1, 2)) / flat_.K(1, 1));
      pose.addPoint(point);
    }
    try {
      vpHomogeneousMatrix best = to_visp(cMe_);
      double least = pose.computeResidual(best);
      for (const auto method : {vpPose::LAGRANGE, vpPose::DEMENTHON}) {
        vpHomogeneousMatrix m;
        try {
          pose.computePose(method, m);
        } catch (const vpException&) {
          continue;
        }
        const double residual = pose.computeResidual(m);
        if (!(residual < least)) continue;
        least = residual;
        best = m;
      }
      pose.computePose(vpPose::VIRTUAL_VS, best);
      const vision::Pose cMe = from_visp(best);
      if (!vision::is_finite(cMe)) return std::nullopt;
      return cMe;
    } catch (const vpException&) {
      return std::nullopt;
    }
  }

  vision::Mount mount_;
  Undistortion undistortion_;
  FlatCamera flat_;
  cv::Mat grey_;
  vpImage<unsigned char> picture_;  // a view of the undistorted grey picture
  std::vector<std::unique_ptr<TrackedLine>> across_;
  std::vector<std::unique_ptr<TrackedLine>> along_;
  std::unique_ptr<TrackedRing> ring_;
  vision::Pose cMe_ = vision::Pose::Identity();
};

}  // namespace

std::unique_ptr<Method> make_visp_lines(const Camera& camera, const CrossingLines& lines) {
  return std::make_unique<VispLines>(camera, lines);
}

}  // namespace hogline::bench
