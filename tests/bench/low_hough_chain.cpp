#include "tests/bench/low_hough_chain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
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
constexpr double max_yaw_rad = 15.0 * degree;
constexpr double max_x_m = 1.2;
constexpr double range_m = 11.0;
constexpr int hough_votes = 60;
constexpr double least_length_px = 60.0;
constexpr double most_gap_px = 15.0;
constexpr std::size_t most_candidates = 30;
constexpr double largest_error_m = 1.0;

struct Segment {
  GroundLine line;
  Eigen::Vector2d a;  // on the ice; of lines across the left end
  Eigen::Vector2d b;
  double length_px = 0.0;

  Eigen::Vector3d homogeneous() const { return a.homogeneous().cross(b.homogeneous()); }
};

struct H {
  const Segment* hog = nullptr;
  Eigen::Vector2d left;
  Eigen::Vector2d right;
  double slope_rad = 0.0;
  double error_m = largest_error_m;
};

class LowHoughChain final : public Method {
 public:
  LowHoughChain(const Camera& camera, double width_m)
      : width_m_(width_m),
        size_(camera.intrinsics.width_px, camera.intrinsics.height_px),
        undistortion_(camera.intrinsics),
        ground_(camera.mount, undistortion_.matrix()) {}

  void start(const Frame&, const vision::Pose&) override {}

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const cv::Mat& picture = undistortion_.apply(frame.image, undistort_s);
    find_segments(picture);
    const auto h = best_h();
    if (!h) return refused("no hog line with two sidelines", undistort_s);
    Look look;
    look.ok = true;
    look.undistort_s = undistort_s;
    look.body.yaw_rad = -h->slope_rad;
    look.body.y_m = rules::tee_to_hog_m - near_edge(*h->hog).line.intercept_m;
    const Eigen::Vector2d along(std::cos(h->slope_rad), std::sin(h->slope_rad));
    look.body.x_m = -0.5 * along.dot(h->left + h->right);
    return look;
  }

 private:
  void find_segments(const cv::Mat& picture) {
    const int first_row = ground_.first_row(range_m);
    cv::cvtColor(picture.rowRange(first_row, picture.rows), grey_, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey_, grey_, {3, 3}, 0.0);
    cv::Canny(grey_, edges_, 50.0, 150.0);
    std::vector<cv::Vec4i> found;
    cv::HoughLinesP(edges_, found, 1.0, 0.25 * degree, hough_votes, least_length_px, most_gap_px);
    across_.clear();
    along_.clear();
    for (const cv::Vec4i& s : found) {
      const Eigen::Vector2d p(s[0], s[1] + first_row);
      const Eigen::Vector2d q(s[2], s[3] + first_row);
      const auto a = ground_.ground(p);
      const auto b = ground_.ground(q);
      if (!a || !b) continue;
      Segment segment{ground_.line(p.homogeneous().cross(q.homogeneous())), *a, *b, (q - p).norm()};
      if (std::abs(segment.line.slope_rad) > max_yaw_rad) continue;
      if (segment.line.across && segment.a.x() > segment.b.x()) std::swap(segment.a, segment.b);
      (segment.line.across ? across_ : along_).push_back(segment);
    }
    for (auto* all : {&across_, &along_}) {
      std::sort(all->begin(), all->end(), [](const Segment& a, const Segment& b) { return a.length_px > b.length_px; });
      all->resize(std::min(all->size(), most_candidates));
    }
  }

  std::optional<H> best_h() const {
    H best;
    const double least_m = rules::min_width_m / 2.0 - max_x_m;
    for (const Segment& hog : across_) {
      if (hog.line.intercept_m < 0.3 || hog.line.intercept_m > range_m) continue;
      for (const Segment& left : along_) {
        if (left.line.intercept_m > -least_m) continue;
        for (const Segment& right : along_) {
          if (right.line.intercept_m < least_m) continue;
          const H h = weigh(hog, left, right);
          if (h.error_m < best.error_m) best = h;
        }
      }
    }
    if (best.hog == nullptr) return std::nullopt;
    return best;
  }

  H weigh(const Segment& hog, const Segment& left, const Segment& right) const {
    H h;
    h.hog = &hog;
    h.left = hog.homogeneous().cross(left.homogeneous()).hnormalized();
    h.right = hog.homogeneous().cross(right.homogeneous()).hnormalized();
    h.slope_rad = (hog.line.slope_rad + left.line.slope_rad + right.line.slope_rad) / 3.0;
    h.error_m = gap(hog.a, h.left) + gap(hog.b, h.right) + std::abs((h.right - h.left).norm() - width_m_);
    return h;
  }

  // Only where the picture shows the intercept.
  double gap(const Eigen::Vector2d& end, const Eigen::Vector2d& intercept) const {
    const auto pixel = ground_.pixel(intercept);
    const bool shown =
        pixel && pixel->x() > 0.0 && pixel->y() > 0.0 && pixel->x() < size_.width && pixel->y() < size_.height;
    return shown ? (end - intercept).norm() : 0.0;
  }

  // The line has two edges; the house-side one counts.
  const Segment& near_edge(const Segment& hog) const {
    const Segment* near = &hog;
    for (const Segment& s : across_) {
      const double before_m = hog.line.intercept_m - s.line.intercept_m;
      const bool other_edge = before_m > 0.6 * rules::hog_line_width_m && before_m < 1.4 * rules::hog_line_width_m;
      if (other_edge && std::abs(s.line.slope_rad - hog.line.slope_rad) < 0.5 * degree) near = &s;
    }
    return *near;
  }

  double width_m_;
  cv::Size size_;
  Undistortion undistortion_;
  FlatGround ground_;
  cv::Mat grey_;
  cv::Mat edges_;
  std::vector<Segment> across_;
  std::vector<Segment> along_;
};

}  // namespace

std::unique_ptr<Method> make_low_hough_chain(const Camera& camera, double sheet_width_m) {
  return std::make_unique<LowHoughChain>(camera, sheet_width_m);
}

}  // namespace hogline::bench
