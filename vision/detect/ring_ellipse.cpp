#include "vision/detect/ring_ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

constexpr std::size_t fewest_points = 60;
constexpr double beside_contour_m = 0.12;
constexpr double worst_residual_px = 3.0;

std::vector<cv::Point> outer_contour(const cv::Mat& mask) {
  // Lines of the ring's colour touch it; they are thinner than any ring.
  cv::Mat closed;
  cv::morphologyEx(mask, closed, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {4, 4}));
  cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(closed, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto largest = std::max_element(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  return largest == contours.end() ? std::vector<cv::Point>{} : *largest;
}

// Edge points whose lighter side is outside, beside the contour.
std::vector<const EdgePoint*> points_beside(const std::vector<cv::Point>& contour, const HouseSegmentation& house,
                                            const std::vector<EdgePoint>& points) {
  cv::Mat line(house.outer_ring.size(), CV_8UC1, cv::Scalar(255));
  for (const cv::Point& p : contour) line.at<std::uint8_t>(p) = 0;
  cv::Mat distance;
  cv::distanceTransform(line, distance, cv::DIST_L2, 3);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const cv::Point& p : contour) middle += house.grid.at(p.x, p.y);
  middle /= static_cast<double>(contour.size());

  std::vector<const EdgePoint*> beside;
  for (const EdgePoint& p : points) {
    const Eigen::Vector2d cell = (p.ground - house.grid.origin) / house.grid.cell_m;
    const int c = static_cast<int>(std::lround(cell.x()));
    const int r = static_cast<int>(std::lround(cell.y()));
    if (c < 0 || r < 0 || c >= distance.cols || r >= distance.rows) continue;
    if (static_cast<double>(distance.at<float>(r, c)) * house.grid.cell_m > beside_contour_m) continue;
    if ((p.ground - middle).normalized().dot(p.ground_normal) > 0.7) beside.push_back(&p);
  }
  return beside;
}

Eigen::Matrix3d conic_of(const cv::RotatedRect& e) {
  const double angle = static_cast<double>(e.angle) * std::numbers::pi / 180.0;
  const double a = 0.5 * static_cast<double>(e.size.width);
  const double b = 0.5 * static_cast<double>(e.size.height);
  Eigen::Matrix3d to_unit;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double x = static_cast<double>(e.center.x);
  const double y = static_cast<double>(e.center.y);
  to_unit << c / a, s / a, -(c * x + s * y) / a, -s / b, c / b, (s * x - c * y) / b, 0.0, 0.0, 1.0;
  const Eigen::Matrix3d conic = to_unit.transpose() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * to_unit;
  return conic / conic.norm();
}

// Distance of a point from a conic, to first order.
double sampson(const Eigen::Matrix3d& conic, const Eigen::Vector2d& n) {
  const Eigen::Vector3d h(n.x(), n.y(), 1.0);
  const Eigen::Vector3d g = conic * h;
  return h.dot(g) / (2.0 * g.head<2>().norm());
}

}  // namespace

std::optional<RingEllipse> fit_outer_ring(const HouseSegmentation& house, const std::vector<EdgePoint>& points,
                                          double pixels_per_unit) {
  const std::vector<cv::Point> contour = outer_contour(house.outer_ring);
  if (contour.size() < 20) return std::nullopt;
  std::vector<const EdgePoint*> used = points_beside(contour, house, points);

  RingEllipse ring;
  for (int round = 0; round < 6; ++round) {
    if (used.size() < fewest_points) return std::nullopt;
    std::vector<cv::Point2f> plane;
    for (const EdgePoint* p : used)
      plane.emplace_back(static_cast<float>(p->plane.x()), static_cast<float>(p->plane.y()));
    const cv::RotatedRect ellipse = cv::fitEllipseDirect(plane);
    if (!(ellipse.size.width > 0.0F && ellipse.size.height > 0.0F)) return std::nullopt;
    ring.conic = conic_of(ellipse);
    if (!ring.conic.allFinite()) return std::nullopt;
    std::vector<double> distances;
    for (const EdgePoint* p : used) distances.push_back(std::abs(sampson(ring.conic, p->plane)) * pixels_per_unit);
    std::vector<double> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double limit = std::max(1.0, 3.0 * 1.4826 * sorted[sorted.size() / 2]);
    double sum = 0.0;
    std::vector<const EdgePoint*> kept;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (distances[i] > limit) continue;
      kept.push_back(used[i]);
      sum += distances[i] * distances[i];
    }
    ring.residual_px = std::sqrt(sum / std::max<double>(1.0, static_cast<double>(kept.size())));
    used = std::move(kept);
  }
  if (ring.residual_px > worst_residual_px) return std::nullopt;
  for (const EdgePoint* p : used) ring.contour.push_back(p->pixel);
  return ring;
}

}  // namespace hogline::vision
