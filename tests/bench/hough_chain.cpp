#include "tests/bench/hough_chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "tests/bench/undistortion.hpp"
#include "vision/geometry/sheet.hpp"
#include "vision/plain/flat_ground.hpp"

namespace hogline::bench {
namespace {

using vision::plain::FlatGround;
using vision::plain::GroundLine;

namespace rules = vision::rules;

constexpr double degree = std::numbers::pi / 180.0;

// Where the robot may stand: the range that hogline's own acquisition searches.
constexpr double max_x_m = 1.2;
constexpr double min_y_m = -5.5;
constexpr double max_y_m = -1.5;
constexpr double max_yaw_rad = 15.0 * degree;
constexpr double slack_m = 0.4;  // the mount's tilt moves far ice by decimetres

constexpr int hough_votes = 150;
constexpr std::size_t most_candidates = 3;  // of each class: more only offer EPnP wrong ones that fit as well
constexpr int opening_px = 7;               // thin lines near by are 5 px wide
constexpr std::size_t least_points = 300;   // of a ring's contour
constexpr int ransac_trials = 150;
constexpr int colour_step_px = 6;  // k-means looks at every sixth pixel both ways

struct Candidate {
  Eigen::Vector3d line;  // homogeneous, pixels
  GroundLine ground;
};

struct Candidates {
  std::vector<Candidate> hog;
  std::vector<Candidate> left;
  std::vector<Candidate> right;
};

// Candidates come with falling votes; one that a stronger one already stands for is dropped.
void add(std::vector<Candidate>& all, const Candidate& candidate) {
  if (all.size() >= most_candidates) return;
  for (const Candidate& c : all) {
    if (std::abs(c.ground.slope_rad - candidate.ground.slope_rad) < 0.2 * degree &&
        std::abs(c.ground.intercept_m - candidate.ground.intercept_m) < 0.03)
      return;
  }
  all.push_back(candidate);
}

struct Ellipse {
  Eigen::Matrix3d conic;
  double support = 0.0;  // points on it, as a share of its circumference
};

Eigen::Matrix3d conic_of(const cv::RotatedRect& box, double grow_px) {
  const double a = 0.5 * static_cast<double>(box.size.width) + grow_px;
  const double b = 0.5 * static_cast<double>(box.size.height) + grow_px;
  const double angle = static_cast<double>(box.angle) * degree;
  Eigen::Matrix3d to_unit;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Eigen::Vector2d centre(static_cast<double>(box.center.x), static_cast<double>(box.center.y));
  to_unit << c / a, s / a, -(c * centre.x() + s * centre.y()) / a, -s / b, c / b,
      -(-s * centre.x() + c * centre.y()) / b, 0.0, 0.0, 1.0;
  return to_unit.transpose() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * to_unit;
}

double distance(const Eigen::Matrix3d& conic, const cv::Point& point) {
  const Eigen::Vector3d p(point.x, point.y, 1.0);
  const Eigen::Vector3d g = conic * p;
  return std::abs(p.dot(g)) / (2.0 * g.head<2>().norm());
}

// Where the line cuts the conic.
std::optional<std::array<Eigen::Vector2d, 2>> cut(const Eigen::Matrix3d& conic, const Eigen::Vector3d& line) {
  const Eigen::Vector2d n = line.head<2>() / line.head<2>().norm();
  const Eigen::Vector2d foot = -line.z() / line.head<2>().norm() * n;
  const Eigen::Vector3d p(foot.x(), foot.y(), 1.0);
  const Eigen::Vector3d d(-n.y(), n.x(), 0.0);
  const double qa = d.dot(conic * d);
  const double qb = d.dot(conic * p);
  const double discriminant = qb * qb - qa * p.dot(conic * p);
  if (!(discriminant > 0.0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return std::array<Eigen::Vector2d, 2>{foot + (-qb + root) / qa * d.head<2>(), foot + (-qb - root) / qa * d.head<2>()};
}

// The paper's figure 4: right, left, far and near point of the ring.
std::optional<std::array<cv::Point2d, 4>> four_points(const Eigen::Matrix3d& conic, const Eigen::Vector3d& hog,
                                                      const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
  const Eigen::Vector3d t_line = conic * left.cross(right);
  auto sides = cut(conic, t_line);
  if (!sides) return std::nullopt;
  auto ends = cut(conic, conic * t_line.cross(hog));
  if (!ends) return std::nullopt;
  if ((*sides)[0].x() < (*sides)[1].x()) std::swap((*sides)[0], (*sides)[1]);
  if ((*ends)[0].y() > (*ends)[1].y()) std::swap((*ends)[0], (*ends)[1]);
  const auto point = [](const Eigen::Vector2d& p) { return cv::Point2d(p.x(), p.y()); };
  return std::array<cv::Point2d, 4>{point((*sides)[0]), point((*sides)[1]), point((*ends)[0]), point((*ends)[1])};
}

class HoughChain final : public Method {
 public:
  explicit HoughChain(const Camera& camera)
      : mount_(camera.mount), undistortion_(camera.intrinsics), ground_(camera.mount, undistortion_.matrix()) {}

  void start(const Frame&, const vision::Pose&) override {}

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const cv::Mat& picture = undistortion_.apply(frame.image, undistort_s);

    const Candidates lines = classified_lines(picture);
    if (lines.hog.empty() || lines.left.empty() || lines.right.empty()) {
      return refused("no candidate for the hog line or a sideline", undistort_s);
    }

    const auto ring = outer_ring(picture, sheet_area(lines, picture.size()));
    if (!ring) return refused("no ellipse among the colours' contours", undistort_s);

    const auto eMc = best_pose(*ring, lines);
    if (!eMc) return refused("no combination gives a pose before the house", undistort_s);
    return {true, {}, vision::planar_body(*eMc, mount_), undistort_s};
  }

 private:
  Candidates classified_lines(const cv::Mat& picture) {
    const int first_row = ground_.first_row(rules::tee_to_hog_m - min_y_m + 2.0);
    const cv::Mat below_horizon = picture.rowRange(first_row, picture.rows);
    cv::cvtColor(below_horizon, grey_, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey_, grey_, {3, 3}, 0.0);
    cv::Canny(grey_, edges_, 50.0, 150.0);
    std::vector<cv::Vec2f> lines;
    cv::HoughLines(edges_, lines, 1.0, 0.25 * degree, hough_votes);  // by falling votes

    Candidates candidates;
    for (const cv::Vec2f& l : lines) {
      const double theta = static_cast<double>(l[1]);
      const double rho = static_cast<double>(l[0]) + std::sin(theta) * first_row;
      const Eigen::Vector3d line(std::cos(theta), std::sin(theta), -rho);
      const GroundLine g = ground_.line(line);
      if (std::abs(g.slope_rad) > max_yaw_rad + 0.03) continue;
      if (g.across) {
        if (g.intercept_m > rules::tee_to_hog_m - max_y_m - slack_m &&
            g.intercept_m < rules::tee_to_hog_m - min_y_m + slack_m)
          add(candidates.hog, {line, g});
      } else if (std::abs(g.intercept_m) > rules::min_width_m / 2.0 - max_x_m &&
                 std::abs(g.intercept_m) < rules::max_width_m / 2.0 + max_x_m) {
        add(g.intercept_m > 0.0 ? candidates.right : candidates.left, {line, g});
      }
    }
    return candidates;
  }

  // What the best three lines bound, down to the picture's lower edge.
  cv::Mat sheet_area(const Candidates& lines, cv::Size size) const {
    const auto crossing = [](const Candidate& a, const Candidate& b) {
      return Eigen::Vector2d(a.line.cross(b.line).hnormalized());
    };
    const auto at_row = [](const Candidate& c, double row) {
      return Eigen::Vector2d(-(c.line.y() * row + c.line.z()) / c.line.x(), row);
    };
    const double bottom = size.height + 50.0;
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& p : {crossing(lines.hog[0], lines.left[0]), crossing(lines.hog[0], lines.right[0]),
                                     at_row(lines.right[0], bottom), at_row(lines.left[0], bottom)}) {
      const auto whole = [](double v) { return static_cast<int>(std::clamp(v, -20000.0, 20000.0)); };
      corners.emplace_back(whole(p.x()), whole(p.y()));
    }
    cv::Mat area(size, CV_8UC1, cv::Scalar(0));
    cv::fillConvexPoly(area, corners, cv::Scalar(255));
    return area;
  }

  // Three colours: ice is the lightest; of the contours of the two others, the ellipse that best fits its own points.
  std::optional<Eigen::Matrix3d> outer_ring(const cv::Mat& picture, const cv::Mat& area) const {
    const cv::Rect box = cv::boundingRect(area);
    if (box.width < 100 || box.height < 100) return std::nullopt;
    const cv::Mat inside = area(box);
    const auto centres = three_colours(picture(box), inside);
    if (!centres) return std::nullopt;
    const std::array<cv::Mat, 2> paints = paint_masks(picture(box), inside, *centres);

    // What the area's own border cuts off is no ring.
    cv::Mat border;
    cv::Mat framed;
    cv::copyMakeBorder(inside, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::erode(framed, border, cv::getStructuringElement(cv::MORPH_RECT, {9, 9}));
    border = border(cv::Rect(1, 1, box.width, box.height));

    Ellipse best{Eigen::Matrix3d::Zero(), 0.2};
    for (const cv::Mat& paint : paints) {
      std::vector<std::vector<cv::Point>> contours;
      cv::findContours(paint, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
      for (const auto& contour : contours) {
        if (contour.size() < least_points) continue;
        // A ring that the picture cuts open has its inner edge in its contour too, which is not on the hull.
        std::vector<cv::Point> hull;
        cv::convexHull(contour, hull);
        std::vector<cv::Point> points;
        for (const cv::Point& p : contour) {
          if (border.at<std::uint8_t>(p) != 0 && cv::pointPolygonTest(hull, p, true) < 2.0) {
            points.push_back(p + box.tl());
          }
        }
        const auto ellipse = fitted(points);
        if (ellipse && ellipse->support > best.support && has_ring_size(ellipse->conic)) best = *ellipse;
      }
    }
    if (best.conic.isZero()) return std::nullopt;
    return best.conic;
  }

  // Columns are cluster centres, the lightest first.
  static std::optional<std::array<cv::Vec3f, 3>> three_colours(const cv::Mat& picture, const cv::Mat& inside) {
    std::vector<cv::Vec3f> samples;
    for (int y = 0; y < picture.rows; y += colour_step_px) {
      for (int x = 0; x < picture.cols; x += colour_step_px) {
        if (inside.at<std::uint8_t>(y, x) != 0) samples.push_back(picture.at<cv::Vec3b>(y, x));
      }
    }
    if (samples.size() < 1000) return std::nullopt;
    cv::Mat labels;
    cv::Mat centres;
    cv::theRNG().state = 1;  // the same picture gives the same answer
    cv::kmeans(cv::Mat(static_cast<int>(samples.size()), 3, CV_32F, samples.data()), 3, labels,
               {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 20, 0.5}, 3, cv::KMEANS_PP_CENTERS, centres);
    std::array<cv::Vec3f, 3> sorted;
    for (int k = 0; k < 3; ++k) sorted[static_cast<std::size_t>(k)] = centres.at<cv::Vec3f>(k, 0);
    const auto lightness = [](const cv::Vec3f& c) { return c[0] + c[1] + c[2]; };
    std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) { return lightness(a) > lightness(b); });
    return sorted;
  }

  // Where the two darker colours are, freed of thin lines.
  static std::array<cv::Mat, 2> paint_masks(const cv::Mat& picture, const cv::Mat& inside,
                                            const std::array<cv::Vec3f, 3>& centres) {
    std::array<cv::Mat, 2> masks{cv::Mat(picture.size(), CV_8UC1, cv::Scalar(0)),
                                 cv::Mat(picture.size(), CV_8UC1, cv::Scalar(0))};
    for (int y = 0; y < picture.rows; ++y) {
      const auto* pixel = picture.ptr<cv::Vec3b>(y);
      const auto* in = inside.ptr<std::uint8_t>(y);
      for (int x = 0; x < picture.cols; ++x) {
        if (in[x] == 0) continue;
        std::array<float, 3> d{};
        for (std::size_t k = 0; k < 3; ++k) {
          for (int i = 0; i < 3; ++i) {
            const float difference = static_cast<float>(pixel[x][i]) - centres[k][i];
            d[k] += difference * difference;
          }
        }
        if (d[1] < d[0] && d[1] <= d[2]) masks[0].ptr<std::uint8_t>(y)[x] = 255;
        if (d[2] < d[0] && d[2] < d[1]) masks[1].ptr<std::uint8_t>(y)[x] = 255;
      }
    }
    const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {opening_px, opening_px});
    for (cv::Mat& mask : masks) cv::morphologyEx(mask, mask, cv::MORPH_OPEN, square);
    return masks;
  }

  // Stones, people and lines stick out of a ring: the ellipse through five points that most of the contour lies on
  // (RANSAC), among those of a ring's size; then fitted to all that is near it.
  std::optional<Ellipse> fitted(std::vector<cv::Point> points) const {
    if (points.size() < least_points) return std::nullopt;
    const std::vector<cv::Point> all = points;
    Eigen::Matrix3d conic = consensus(all);
    if (conic.isZero()) return std::nullopt;
    for (const double reach_px : {4.0, 3.0, 2.0}) {
      points.clear();
      for (const cv::Point& p : all) {
        if (distance(conic, p) < reach_px) points.push_back(p);
      }
      if (points.size() < least_points) return std::nullopt;
      conic = conic_of(cv::fitEllipseDirect(points), 0.0);
      if (!conic.allFinite()) return std::nullopt;
    }
    const cv::RotatedRect box = cv::fitEllipseDirect(points);
    const double a = 0.5 * static_cast<double>(box.size.width);
    const double b = 0.5 * static_cast<double>(box.size.height);
    const double h = std::pow((a - b) / (a + b), 2);
    const double around = std::numbers::pi * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
    // A contour runs through the centres of the paint's last pixels: the paint ends half a pixel farther out.
    return Ellipse{conic_of(box, 0.5), static_cast<double>(points.size()) / around};
  }

  Eigen::Matrix3d consensus(const std::vector<cv::Point>& points) const {
    cv::RNG random(1);  // the same picture gives the same answer
    Eigen::Matrix3d best = Eigen::Matrix3d::Zero();
    int most = 0;
    for (int trial = 0; trial < ransac_trials; ++trial) {
      std::vector<cv::Point> five;
      for (int i = 0; i < 5; ++i) {
        five.push_back(points[static_cast<std::size_t>(random.uniform(0, static_cast<int>(points.size())))]);
      }
      const Eigen::Matrix3d conic = conic_of(cv::fitEllipseDirect(five), 0.0);
      if (!conic.allFinite()) continue;
      int near = 0;
      for (std::size_t i = 0; i < points.size(); i += 10) near += distance(conic, points[i]) < 3.0 ? 1 : 0;
      if (near <= most || !has_ring_size(conic)) continue;
      most = near;
      best = conic;
    }
    return best;
  }

  // The outer ring is 3.66 m wide on the ice. Seen from near by, its ellipse's centre lies before its own, where it is
  // up to a fifth narrower; the next ring is a third narrower.
  bool has_ring_size(const Eigen::Matrix3d& conic) const {
    const Eigen::Vector3d centre = conic.inverse().col(2);
    const auto ends = cut(conic, {0.0, centre.z(), -centre.y()});
    if (!ends) return false;
    const auto a = ground_.ground((*ends)[0]);
    const auto b = ground_.ground((*ends)[1]);
    if (!a || !b) return false;
    const double width = (*a - *b).norm() / (2.0 * rules::outer_ring_radius_m);
    return width > 0.75 && width < 1.1;
  }

  std::optional<vision::Pose> best_pose(const Eigen::Matrix3d& ring, const Candidates& lines) const {
    const double R = rules::outer_ring_radius_m;
    const std::vector<cv::Point3d> sheet{{R, 0.0, 0.0}, {-R, 0.0, 0.0}, {0.0, R, 0.0}, {0.0, -R, 0.0}};
    std::optional<vision::Pose> best;
    double least_px = 1e9;
    for (const Candidate& h : lines.hog) {
      for (const Candidate& l : lines.left) {
        for (const Candidate& r : lines.right) {
          const auto points = four_points(ring, h.line, l.line, r.line);
          if (!points) continue;
          const std::vector<cv::Point2d> image(points->begin(), points->end());
          cv::Vec3d rotation;
          cv::Vec3d translation;
          if (!cv::solvePnP(sheet, image, undistortion_.matrix(), cv::noArray(), rotation, translation, false,
                            cv::SOLVEPNP_EPNP))
            continue;
          std::vector<cv::Point2d> projected;
          cv::projectPoints(sheet, rotation, translation, undistortion_.matrix(), cv::noArray(), projected);
          const double error_px = cv::norm(image, projected, cv::NORM_L2);
          const vision::Pose eMc = pose_of(rotation, translation);
          if (!(error_px < least_px) || !in_range(eMc)) continue;
          least_px = error_px;
          best = eMc;
        }
      }
    }
    return best;
  }

  static vision::Pose pose_of(const cv::Vec3d& rotation, const cv::Vec3d& translation) {
    vision::Pose cMe = vision::Pose::Identity();
    const Eigen::Vector3d r(rotation[0], rotation[1], rotation[2]);
    if (r.norm() > 0.0) cMe.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
    cMe.translation() << translation[0], translation[1], translation[2];
    return cMe.inverse();
  }

  bool in_range(const vision::Pose& eMc) const {
    if (!vision::is_finite(eMc)) return false;
    const PlanarPose body = vision::planar_body(eMc, mount_);
    return std::abs(body.x_m) < max_x_m && body.y_m > min_y_m && body.y_m < max_y_m &&
           std::abs(body.yaw_rad) < max_yaw_rad && std::abs(eMc.translation().z() - mount_.z_m) < 0.4;
  }

  vision::Mount mount_;
  Undistortion undistortion_;
  FlatGround ground_;
  cv::Mat grey_;
  cv::Mat edges_;
};

}  // namespace

std::unique_ptr<Method> make_hough_chain(const Camera& camera) { return std::make_unique<HoughChain>(camera); }

}  // namespace hogline::bench
