#include "vision/detect/h_lines.hpp"

#include <algorithm>
#include <cmath>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double yaw_step_rad = 0.00873;  // half a degree
constexpr double log_step = 0.012;  // of the distance from the camera: 1.2 %, half a pixel at 6 m and 0.5 m height
constexpr double nearest_m = 0.15;  // ahead of the camera
constexpr int fewest_supporters = 14;
constexpr double supporter_px = 2.0;
constexpr double least_contrast = 0.18;  // a black line of 0.0127 m takes away as much light as 0.125 of a hog line
constexpr double width_tolerance = 0.3;

// The foot frame: `across` per metre ahead and the inverse of metres ahead of the camera. Straight lines on the ice are
// straight in it, and its errors are pixels everywhere.
struct FootPoint {
  double s;
  double q;
};

struct Line {
  double yaw_rad;
  double distance_m;  // from the camera's foot
  double q_at(double s) const { return (std::cos(yaw_rad) + s * std::sin(yaw_rad)) / distance_m; }
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Search {
 public:
  Search(const std::vector<HogRidge>& ridges, const HogRidgeFinder& finder, const GroundView& view,
         const CrossRange& range)
      : ridges_(ridges), finder_(finder), view_(view), range_(range), foot_(view.gMc().translation().head<2>()) {
    within_ = supporter_px / (view.setup().intrinsics.fy_px * view.gMc().translation().z());
    yaws_ = 1 + static_cast<int>(std::lround((range.max_yaw_rad - range.min_yaw_rad) / yaw_step_rad));
    logs_ = 2 + static_cast<int>(std::log(std::max(range.max_distance_m - foot_.y(), 2.0 * nearest_m) / nearest_m) /
                                 log_step);
    votes_.assign(static_cast<std::size_t>(yaws_) * static_cast<std::size_t>(logs_), 0.0F);
    for (const HogRidge& r : ridges_) {
      const Eigen::Vector2d g = r.ice - foot_;
      points_.push_back({g.x() / g.y(), 1.0 / g.y()});
    }
  }

  void vote() {
    for (int y = 0; y < yaws_; ++y) {
      const double yaw = yaw_of(y);
      for (std::size_t i = 0; i < ridges_.size(); ++i) {
        const double distance = (std::cos(yaw) + points_[i].s * std::sin(yaw)) / points_[i].q;
        if (!(distance > nearest_m)) continue;
        const double bin = std::log(distance / nearest_m) / log_step;
        const int b = static_cast<int>(bin);
        if (b + 1 >= logs_) continue;
        const float weight = static_cast<float>(std::min(ridges_[i].strength, 0.4));
        const float share = static_cast<float>(bin - b);
        at(y, b) += (1.0F - share) * weight;
        at(y, b + 1) += share * weight;
      }
    }
  }

  // Peaks, strongest first.
  std::vector<Line> peaks(std::size_t most) const {
    std::vector<std::pair<float, Line>> found;
    for (int y = 0; y < yaws_; ++y) {
      for (int b = 1; b + 1 < logs_; ++b) {
        const float v = votes_[index(y, b)];
        if (v < 1.0F || !is_peak(y, b, v)) continue;
        found.push_back({v, {yaw_of(y), nearest_m * std::exp(b * log_step)}});
      }
    }
    const std::size_t count = std::min(most, found.size());
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), found.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Line> lines;
    for (std::size_t i = 0; i < count; ++i) lines.push_back(found[i].second);
    return lines;
  }

  // Tukey-weighted least squares of q over s, closing in on the line.
  bool refine(Line& line) const {
    for (const double wide : {4.0, 2.0, 1.0, 1.0}) {
      const double limit = wide * within_ + (wide > 1.0 ? 0.01 * wide / line.distance_m : 0.0);
      double w0 = 0.0, ws = 0.0, wss = 0.0, wq = 0.0, wsq = 0.0;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const double u = (points_[i].q - line.q_at(points_[i].s)) / limit;
        if (std::abs(u) >= 1.0) continue;
        const double w = (1.0 - u * u) * (1.0 - u * u) * ridges_[i].strength;
        w0 += w;
        ws += w * points_[i].s;
        wss += w * points_[i].s * points_[i].s;
        wq += w * points_[i].q;
        wsq += w * points_[i].s * points_[i].q;
      }
      const double det = w0 * wss - ws * ws;
      if (!(det > 1e-6 * w0 * w0)) return false;
      const double slope = (w0 * wsq - ws * wq) / det;
      const double q0 = (wq - slope * ws) / w0;
      if (!(q0 > 0.0)) return false;
      line.yaw_rad = std::atan2(slope, q0);
      line.distance_m = 1.0 / std::hypot(slope, q0);
    }
    return line.yaw_rad > range_.min_yaw_rad - 0.03 && line.yaw_rad < range_.max_yaw_rad + 0.03;
  }

  CrossCandidate describe(const Line& line) const {
    std::vector<double> contrasts;
    std::vector<double> widths;
    std::vector<double> xs;
    std::vector<bool> seen(static_cast<std::size_t>(finder_.blocks()), false);
    int inside = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::size_t block = static_cast<std::size_t>(ridges_[i].column);
      if (std::abs(points_[i].q - line.q_at(points_[i].s)) > within_ || seen[block]) continue;
      seen[block] = true;
      contrasts.push_back(ridges_[i].contrast);
      xs.push_back(ridges_[i].ice.x());
      if (ridges_[i].width_m > 0.0) widths.push_back(ridges_[i].width_m);
      inside += std::abs(ridges_[i].ice.x()) < half_narrowest_m ? 1 : 0;
    }
    CrossCandidate c;
    c.yaw_rad = line.yaw_rad;
    c.distance_m = line.distance_m + foot_.dot(c.normal());
    c.supporters = static_cast<int>(xs.size());
    if (xs.empty()) return c;
    c.contrast = median(contrasts);
    c.width_m = 2 * widths.size() > xs.size() ? median(widths) : 0.0;
    std::sort(xs.begin(), xs.end());
    c.begin_x_m = xs[xs.size() / 50];
    c.end_x_m = xs[xs.size() - 1 - xs.size() / 50];
    c.visible = static_cast<double>(inside) / std::max(1.0, columns_of(c));
    return c;
  }

  static std::string no_hog_line(const CrossCandidate& c) {
    if (c.supporters < fewest_supporters) return "too short";
    if (c.contrast < least_contrast) return "too thin";
    const double error = std::abs(c.width_m - rules::hog_line_width_m);
    if (c.width_m > 0.0 && error > width_tolerance * rules::hog_line_width_m) return "wrong width";
    return {};
  }

 private:
  static constexpr double half_narrowest_m = rules::min_width_m / 2.0;

  double yaw_of(int bin) const { return range_.min_yaw_rad + bin * yaw_step_rad; }
  std::size_t index(int y, int b) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(logs_) + static_cast<std::size_t>(b);
  }
  float& at(int y, int b) { return votes_[index(y, b)]; }

  bool is_peak(int y, int b, float v) const {
    for (int dy = -2; dy <= 2; ++dy) {
      for (int db = -2; db <= 2; ++db) {
        if (y + dy < 0 || y + dy >= yaws_ || b + db < 0 || b + db >= logs_) continue;
        if (votes_[index(y + dy, b + db)] > v) return false;
      }
    }
    return true;
  }

  // How many blocks of columns a line of the narrowest sheet's length could be seen in.
  double columns_of(const CrossCandidate& c) const {
    constexpr int steps = 64;
    double columns_px = 0.0;
    std::optional<Eigen::Vector2d> before;
    for (int i = 0; i <= steps; ++i) {
      auto pixel = view_.pixel_of_ground(c.at(half_narrowest_m * (2.0 * i / steps - 1.0)));
      if (pixel && !view_.lens().in_picture(*pixel)) pixel.reset();
      if (pixel && before) columns_px += std::abs(pixel->x() - before->x());
      before = pixel;
    }
    return columns_px / HogRidgeFinder::block_px;
  }

  const std::vector<HogRidge>& ridges_;
  const HogRidgeFinder& finder_;
  const GroundView& view_;
  CrossRange range_;
  Eigen::Vector2d foot_;
  double within_;
  int yaws_;
  int logs_;
  std::vector<float> votes_;
  std::vector<FootPoint> points_;
};

bool same(const CrossCandidate& a, const CrossCandidate& b) {
  return std::abs(a.distance_m - b.distance_m) < 0.03 * b.distance_m && std::abs(a.yaw_rad - b.yaw_rad) < 0.02;
}

}  // namespace

Eigen::Vector2d CrossCandidate::normal() const { return {std::sin(yaw_rad), std::cos(yaw_rad)}; }

Eigen::Vector2d CrossCandidate::at(double x_m) const {
  return {x_m, (distance_m - x_m * std::sin(yaw_rad)) / std::cos(yaw_rad)};
}

std::vector<CrossCandidate> find_cross_candidates(const std::vector<HogRidge>& ridges, const HogRidgeFinder& finder,
                                                  const GroundView& view, const CrossRange& range, std::size_t most,
                                                  int* too_thin) {
  Search search(ridges, finder, view, range);
  search.vote();
  std::vector<CrossCandidate> found;
  int refused = 0;
  for (Line line : search.peaks(5 * most)) {
    if (!search.refine(line)) continue;
    const CrossCandidate c = search.describe(line);
    if (c.distance_m < range.min_distance_m || c.distance_m > range.max_distance_m) continue;
    if (std::any_of(found.begin(), found.end(), [&](const CrossCandidate& f) { return same(f, c); })) continue;
    if (const std::string why = Search::no_hog_line(c); !why.empty()) {
      refused += why == "too short" ? 0 : 1;
      continue;
    }
    found.push_back(c);
  }
  if (too_thin != nullptr) *too_thin = refused;
  std::sort(found.begin(), found.end(),
            [](const CrossCandidate& a, const CrossCandidate& b) { return a.supporters > b.supporters; });
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace hogline::vision
