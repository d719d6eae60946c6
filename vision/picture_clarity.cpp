#include "vision/picture_clarity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "vision/edges/localise.hpp"
#include "vision/edges/profile.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr int cuts_a_ring = 14;
constexpr double clear_px = 20.0;  // of the picture's border
constexpr std::size_t least_cuts = 5;
constexpr double least_contrast = 0.05;
constexpr int rows_apart = 24;

double middle(std::vector<double>& numbers) {
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), at, numbers.end());
  return *at;
}

std::string decimals(double value, int count) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", count, value);
  return text.data();
}

/// Across a ring's edge, where it is seen.
std::optional<Cut> cut_across(const SheetCamera& camera, double radius_m, double angle, double reach_px) {
  const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
  const auto pixel = camera.project_paint(radius_m * outward);
  const auto beside = camera.project_paint(radius_m * outward + 0.005 * Eigen::Vector2d(-outward.y(), outward.x()));
  if (!pixel || !beside || !camera.lens().in_picture(*pixel, clear_px)) return {};
  const Eigen::Vector2d along = (*beside - *pixel).normalized();
  return Cut{*pixel, {-along.y(), along.x()}, -reach_px, reach_px, 0.5, 1};
}

/// How far about an edge is looked, and what is expected there.
struct Window {
  double blur_px;
  double beside_px;
  double shift_px;
};
constexpr Window sharp{1.0, 5.0, 2.5};
constexpr Window smeared{3.0, 14.0, 5.0};

/// Edges of one direction: those that should be in sight, and the blur of those that were found.
struct Edges {
  std::size_t tried = 0;
  std::vector<double> blurs_px;

  bool known() const { return blurs_px.size() >= least_cuts; }
  bool missing() const { return tried >= 2 * least_cuts && !known(); }
};

struct RingEdges {
  Edges upright;  ///< in the picture
  Edges lying;

  std::optional<double> blur_px() {
    if (!upright.known() && !lying.known()) return {};
    if (!upright.known()) return middle(lying.blurs_px);
    if (!lying.known()) return middle(upright.blurs_px);
    return std::sqrt(middle(upright.blurs_px) * middle(lying.blurs_px));
  }
};

RingEdges ring_edges(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera,
                     const Window& window) {
  RingEdges edges;
  Profile profile;
  const double reach_px = window.beside_px + window.shift_px + 0.5;
  for (const double radius_m : {rules::outer_ring_radius_m, rules::middle_ring_radius_m, rules::inner_ring_radius_m}) {
    for (int i = 0; i < cuts_a_ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / cuts_a_ring;
      const auto cut = cut_across(camera, radius_m, angle, reach_px);
      if (!cut || !sample(picture, response, *cut, profile)) continue;
      Edges& same = std::abs(cut->normal.x()) > std::abs(cut->normal.y()) ? edges.upright : edges.lying;
      ++same.tried;
      const LocalEdge edge = locate(profile, {.blur_px = window.blur_px,
                                              .before_px = window.beside_px,
                                              .after_px = window.beside_px,
                                              .max_shift_px = window.shift_px});
      if (edge.ok() && edge.contrast >= least_contrast) same.blurs_px.push_back(edge.blur_px);
    }
  }
  return edges;
}

// Edges that are smeared over more than the window are not found in it.
std::optional<double> blur_of(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera) {
  RingEdges edges = ring_edges(picture, response, camera, sharp);
  if (edges.upright.missing() || edges.lying.missing()) edges = ring_edges(picture, response, camera, smeared);
  return edges.blur_px();
}

/// Of white ice alone: between its pixels and their neighbours on both sides in the row there is nothing but noise.
class IceNoise {
 public:
  explicit IceNoise(const ResponseCurve& response) {
    for (std::size_t i = 0; i < root_.size(); ++i) root_[i] = std::sqrt(response.linear(static_cast<std::uint8_t>(i)));
  }

  void look(const cv::Mat& bgr, const WhiteLight& ice, int row) {
    const std::uint8_t* pixels = bgr.ptr<std::uint8_t>(row);
    for (int x = columns_apart; x + 1 < bgr.cols; x += columns_apart) {
      const std::array<float, 3> white = ice.at(x, row);
      const std::uint8_t* here = pixels + 3 * x;
      std::array<float, 3> bend{};
      bool is_ice = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const float full = std::sqrt(white[k]);
        is_ice = is_ice && root_[here[k]] > least_ice * full && here[k] < 255;
        bend[k] = std::abs(root_[*(here + k - 3)] - 2.0F * root_[here[k]] + root_[here[k + 3]]) / full;
      }
      if (is_ice) bends_.push_back(static_cast<double>(bend[0] + bend[1] + bend[2]) / 3.0);
    }
  }

  std::optional<double> sigma() {
    constexpr double of_a_normal_bend = 0.7979 * 2.4495;  // mean size; three pixels, of which one counts twice
    if (bends_.size() < least_pixels) return {};
    return middle(bends_) / of_a_normal_bend;
  }

 private:
  static constexpr int columns_apart = 12;
  static constexpr float least_ice = 0.8F;
  static constexpr std::size_t least_pixels = 200;

  std::array<float, 256> root_{};
  std::vector<double> bends_;
};

}  // namespace

PictureClarity clarity_of(const cv::Mat& bgr, const ResponseCurve& response, const WhiteLight& ice,
                          const SheetCamera& camera) {
  PictureClarity clarity;
  clarity.blur_px = blur_of({bgr.data, bgr.cols, bgr.rows, 3, bgr.step[0]}, response, camera);
  IceNoise noise(response);
  for (int row = bgr.rows / 2; row < bgr.rows; row += rows_apart) noise.look(bgr, ice, row);
  clarity.noise = noise.sigma();
  return clarity;
}

std::string PictureClarity::fault(const ClarityLimits& limits) const {
  if (blur_px && *blur_px > limits.blur_px) {
    return "blurred: " + decimals(*blur_px, 1) + " px where paint ends, " + decimals(limits.blur_px, 1) +
           " at most; clean and focus the lens, or let the camera stand still";
  }
  if (noise && *noise > limits.noise) {
    return "noisy: " + decimals(*noise, 3) + " of white ice, " + decimals(limits.noise, 3) +
           " at most; give the camera more light or less gain";
  }
  return {};
}

}  // namespace hogline::vision
