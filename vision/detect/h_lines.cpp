#include "vision/detect/h_lines.hpp"

#include <algorithm>
#include <array>
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
constexpr double least_evidence = 10.0;  // tens of thousands of lines are tried: by chance one reaches 4 or 5

// The foot frame: `across` per metre ahead and the inverse of metres ahead of the camera. Straight lines on the ice are
// straight in it, and its errors are pixels everywhere.
struct FootPoint {
  double s;
  double q;
  double log_bin;  ///< of a line straight across through it
};

// log(x) / log_step by table, for x from `least` to `most`; 0.1 off at most.
class LogBins {
 public:
  static constexpr float least = 0.1F;
  static constexpr float most = 4.0F;

  LogBins() {
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const float x = least + (static_cast<float>(i) + 0.5F) / per_unit;
      bins_[i] = std::log(x) / static_cast<float>(log_step);
    }
  }
  float operator()(float x) const { return bins_[static_cast<std::size_t>((x - least) * per_unit)]; }

 private:
  static constexpr float per_unit = 4096.0F;
  std::array<float, static_cast<std::size_t>((most - least) * per_unit) + 1> bins_{};
};

const LogBins& log_bins() {
  static const LogBins table;
  return table;
}

/// q = at_zero + slope * s.
struct Line {
  double at_zero;
  double slope;

  static Line of(double yaw_rad, double distance_m) {  // from the camera's foot
    return {std::cos(yaw_rad) / distance_m, std::sin(yaw_rad) / distance_m};
  }
  double q_at(double s) const { return at_zero + slope * s; }
  double yaw_rad() const { return std::atan2(slope, at_zero); }
  double distance_m() const { return 1.0 / std::hypot(slope, at_zero); }
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
      : ridges_(ridges), finder_(finder), range_(range), foot_(view.gMc().translation().head<2>()) {
    within_ = supporter_px / (view.setup().intrinsics.fy_px * view.gMc().translation().z());
    yaws_ = 1 + static_cast<int>(std::lround((range.max_yaw_rad - range.min_yaw_rad) / yaw_step_rad));
    logs_ = 2 + static_cast<int>(std::log(std::max(range.max_distance_m - foot_.y(), 2.0 * nearest_m) / nearest_m) /
                                 log_step);
    votes_.assign(static_cast<std::size_t>(yaws_) * static_cast<std::size_t>(logs_), 0.0F);
    for (const HogRidge& r : ridges_) {
      const Eigen::Vector2d g = r.ice - foot_;
      points_.push_back({g.x() / g.y(), 1.0 / g.y(), std::log(g.y() / nearest_m) / log_step});
    }
    taken_.assign(points_.size(), false);
  }

  void vote() {
    const LogBins& log_of = log_bins();
    for (int y = 0; y < yaws_; ++y) {
      const auto cosine = static_cast<float>(std::cos(yaw_of(y)));
      const auto sine = static_cast<float>(std::sin(yaw_of(y)));
      for (std::size_t i = 0; i < ridges_.size(); ++i) {
        const float turned = cosine + static_cast<float>(points_[i].s) * sine;
        if (!(turned > LogBins::least && turned < LogBins::most)) continue;
        const float bin = static_cast<float>(points_[i].log_bin) + log_of(turned);
        const int b = static_cast<int>(bin);
        if (bin < 0.0F || b + 1 >= logs_) continue;
        const float weight = static_cast<float>(std::min(ridges_[i].strength, 0.4));
        const float share = bin - static_cast<float>(b);
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
        found.push_back({v, Line::of(yaw_of(y), nearest_m * std::exp(b * log_step))});
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
      const double slack = wide > 1.0 ? 0.01 * wide * line.at_zero : 0.0;
      double w0 = 0.0, ws = 0.0, wss = 0.0, wq = 0.0, wsq = 0.0;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        const double limit = wide * tolerance(points_[i]) + slack;
        const double u = (points_[i].q - line.q_at(points_[i].s)) / limit;
        if (taken_[i] || std::abs(u) >= 1.0) continue;
        const double w = (1.0 - u * u) * (1.0 - u * u) * ridges_[i].strength;
        w0 += w;
        ws += w * points_[i].s;
        wss += w * points_[i].s * points_[i].s;
        wq += w * points_[i].q;
        wsq += w * points_[i].s * points_[i].q;
      }
      const double det = w0 * wss - ws * ws;
      if (!(det > 1e-6 * w0 * w0)) return false;
      line.slope = (w0 * wsq - ws * wq) / det;
      line.at_zero = (wq - line.slope * ws) / w0;
      if (!(line.at_zero > 0.0)) return false;
    }
    return line.yaw_rad() > range_.min_yaw_rad - 0.03 && line.yaw_rad() < range_.max_yaw_rad + 0.03;
  }

  CrossCandidate describe(const Line& line) const {
    CrossCandidate c;
    c.yaw_rad = line.yaw_rad();
    c.distance_m = line.distance_m() + foot_.dot(c.normal());
    std::vector<double> widths;
    std::vector<double> contrasts;
    std::vector<double> xs;
    for (const std::size_t i : supporters_of(line)) {
      contrasts.push_back(ridges_[i].contrast);
      xs.push_back(ridges_[i].ice.x());
      if (ridges_[i].width_m > 0.0) widths.push_back(ridges_[i].width_m);
    }
    c.supporters = static_cast<int>(xs.size());
    if (xs.empty()) return c;
    c.contrast = median(contrasts);
    c.width_m = 2 * widths.size() > xs.size() ? median(widths) : 0.0;
    std::sort(xs.begin(), xs.end());
    c.begin_x_m = xs[xs.size() / 50];
    c.end_x_m = xs[xs.size() - 1 - xs.size() / 50];
    weigh(c);
    return c;
  }

  // What one line explains is no evidence for another.
  void take(const Line& line) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (std::abs(points_[i].q - line.q_at(points_[i].s)) < 2.0 * tolerance(points_[i])) taken_[i] = true;
    }
  }

  static std::string no_hog_line(const CrossCandidate& c) {
    if (c.supporters < fewest_supporters || c.evidence < least_evidence) return "no line";
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

  // Wide paint is located less well, in pixels, than thin paint.
  double tolerance(const FootPoint& p) const { return within_ + 0.08 * rules::hog_line_width_m * p.q * p.q; }

  // One ridge of each block of columns, the nearest to the line.
  std::vector<std::size_t> supporters_of(const Line& line) const {
    std::vector<std::size_t> nearest;
    int block = -1;
    double best = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double off = std::abs(points_[i].q - line.q_at(points_[i].s)) / tolerance(points_[i]);
      if (taken_[i] || off > 1.0) continue;
      if (ridges_[i].column != block) {
        nearest.push_back(i);
      } else if (off < best) {
        nearest.back() = i;
      } else {
        continue;
      }
      block = ridges_[i].column;
      best = off;
    }
    return nearest;
  }

  // Looks at every column that a line of the narrowest sheet's length crosses, whether it was a ridge there or not.
  void weigh(CrossCandidate& c) const {
    constexpr int steps = 64;
    std::optional<Eigen::Vector2d> before;
    double sum = 0.0, square = 0.0;
    int columns = 0, seen = 0;
    for (int i = 0; i <= steps; ++i) {
      auto pixel = finder_.camera().project_paint(c.at(half_narrowest_m * (2.0 * i / steps - 1.0)));
      if (pixel && !finder_.camera().lens().in_picture(*pixel)) pixel.reset();
      if (pixel && before) {
        for (int block = finder_.block_of(before->x()); block < finder_.block_of(pixel->x()); ++block) {
          const double t = (finder_.column_px(block) - before->x()) / (pixel->x() - before->x());
          const double v = finder_.contrast_at(block, before->y() + t * (pixel->y() - before->y())).value_or(0.0);
          sum += v;
          square += v * v;
          seen += v > 0.5 * c.contrast ? 1 : 0;
          ++columns;
        }
      }
      before = pixel;
    }
    if (columns < fewest_supporters) return;
    const double mean = sum / columns;
    const double variance = std::max(square / columns - mean * mean, 1e-6);
    c.visible = static_cast<double>(seen) / columns;
    c.evidence = mean / std::sqrt(variance / columns);
  }

  const std::vector<HogRidge>& ridges_;
  const HogRidgeFinder& finder_;
  CrossRange range_;
  Eigen::Vector2d foot_;
  double within_;
  int yaws_;
  int logs_;
  std::vector<float> votes_;
  std::vector<FootPoint> points_;
  std::vector<bool> taken_;
};

}  // namespace

Eigen::Vector2d CrossCandidate::normal() const { return {std::sin(yaw_rad), std::cos(yaw_rad)}; }

Eigen::Vector2d CrossCandidate::at(double x_m) const {
  return {x_m, (distance_m - x_m * std::sin(yaw_rad)) / std::cos(yaw_rad)};
}

std::vector<CrossCandidate> find_cross_candidates(const std::vector<HogRidge>& ridges, const HogRidgeFinder& finder,
                                                  const GroundView& view, const CrossRange& range, std::size_t most,
                                                  int* too_thin) {
  if (too_thin != nullptr) *too_thin = 0;
  const bool anything =
      range.max_yaw_rad > range.min_yaw_rad && range.max_distance_m > std::max(range.min_distance_m, 0.0);
  if (!anything) return {};
  Search search(ridges, finder, view, range);
  search.vote();
  std::vector<CrossCandidate> found;
  int refused = 0;
  for (Line line : search.peaks(4 * most)) {
    if (found.size() >= most || !search.refine(line)) continue;
    const CrossCandidate c = search.describe(line);
    if (c.distance_m < range.min_distance_m || c.distance_m > range.max_distance_m) continue;
    const std::string why = Search::no_hog_line(c);
    if (why == "no line") continue;
    search.take(line);
    if (why.empty()) {
      found.push_back(c);
    } else {
      ++refused;
    }
  }
  if (too_thin != nullptr) *too_thin = refused;
  std::sort(found.begin(), found.end(),
            [](const CrossCandidate& a, const CrossCandidate& b) { return a.evidence > b.evidence; });
  return found;
}

}  // namespace hogline::vision
