#include "vision/edges/moving_edges.hpp"

#include <visp3/core/vpImage.h>
#include <visp3/me/vpMe.h>
#include <visp3/me/vpMeSite.h>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr int mask_px = 5;
constexpr int half_mask_px = 2;
constexpr int border_px = half_mask_px + 3;  // vpMeSite refuses sites nearer to the image's border
constexpr int most_half_width_px = 10;
constexpr int most_steps = MovingEdges::max_range_px + most_half_width_px;
constexpr int patch_px = 2 * (most_steps + border_px) + 4;
constexpr double tolerance = 0.5;            // of the contrast from frame to frame: vpMe's mu1 and mu2
constexpr double least_half_width_px = 1.5;  // the masks' answers to a thinner line's edges lie this far apart
constexpr double pi = 3.14159265358979323846;

// Grey as a weighted sum of the channels, moved into 0..255.
struct Grey {
  std::array<int, 3> weight{};
  int base = 0;

  Grey(const std::array<float, 3>& colour, int channels) {
    float sum = 0.0F;
    for (int c = 0; c < channels; ++c) sum += std::abs(colour[static_cast<std::size_t>(c)]);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      weight[c] = static_cast<int>(std::lround(256.0F * colour[c] / std::max(sum, 1e-6F)));
      if (weight[c] < 0) base -= 255 * weight[c];
    }
  }
  template <int channels>
  unsigned char of(const std::uint8_t* pixel) const {
    int sum = base;
    for (int c = 0; c < channels; ++c) sum += weight[static_cast<std::size_t>(c)] * pixel[c];
    return static_cast<unsigned char>(sum >> 8);  // the weights' sum is at most 257: no overflow
  }
};

template <int channels>
void convert(const Grey& grey, const std::uint8_t* from, unsigned char* to, int pixels) {
  for (int x = 0; x < pixels; ++x) to[x] = grey.of<channels>(from + channels * x);
}

}  // namespace

struct MovingEdges::Impl {
  explicit Impl(double contrast);

  bool cut_out(const Picture& picture, const MovingEdge& edge, int steps);
  double answer(double x, double y, double angle, int degree, double& at_x, double& at_y);
  MovedEdge choose(const MovingEdge& edge, int half_width) const;

  double least_contrast;
  vpMe me;
  vpImage<unsigned char> patch{patch_px, patch_px, 0};
  int left = 0;  // of the patch in the picture
  int top = 0;
  std::array<double, 360> gain{};  // a mask's answer to a step of one grey level, by the normal's angle in degrees
  std::array<double, 2 * most_steps + 1> answers{};
  std::array<double, 2 * most_steps + 1> places{};  // of the pixels that answered, along the normal
};

MovingEdges::Impl::Impl(double contrast) : least_contrast(contrast) {
  me.setMaskSize(mask_px);
  me.setMaskNumber(180);
  me.setStrip(0);
  me.setMu1(tolerance);
  me.setMu2(tolerance);
  me.initMask();
  // The masks are known by what they answer to a step of 100 through their middle.
  const int middle = patch_px / 2;
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = degree * pi / 180.0;
    for (int i = 0; i < patch_px; ++i) {
      for (int j = 0; j < patch_px; ++j) {
        const double beyond = (j - middle) * std::cos(angle) + (i - middle) * std::sin(angle);
        patch[i][j] = static_cast<unsigned char>(std::lround(128.0 + 100.0 * std::clamp(beyond, -0.5, 0.5)));
      }
    }
    vpMeSite site;
    site.init(middle, middle, angle);
    gain[static_cast<std::size_t>(degree)] = site.convolution(patch, &me) / 100.0;
  }
}

// The few pixels that the search may touch, as grey.
bool MovingEdges::Impl::cut_out(const Picture& picture, const MovingEdge& edge, int steps) {
  const double reach_x = steps * std::abs(edge.normal.x());
  const double reach_y = steps * std::abs(edge.normal.y());
  left = static_cast<int>(std::floor(edge.pixel.x() - reach_x)) - border_px;
  top = static_cast<int>(std::floor(edge.pixel.y() - reach_y)) - border_px;
  const int right = static_cast<int>(std::ceil(edge.pixel.x() + reach_x)) + half_mask_px + 1;
  const int bottom = static_cast<int>(std::ceil(edge.pixel.y() + reach_y)) + half_mask_px + 1;
  if (left < 0 || top < 0 || right > picture.width_px || bottom > picture.height_px) return false;
  const Grey grey(edge.colour, picture.channels);
  for (int y = top + border_px - half_mask_px; y < bottom; ++y) {
    const int begin = left + border_px - half_mask_px;
    const std::uint8_t* from =
        picture.pixels + static_cast<std::size_t>(y) * picture.row_bytes + begin * picture.channels;
    unsigned char* to = patch[static_cast<unsigned>(y - top)] + begin - left;
    picture.channels == 3 ? convert<3>(grey, from, to, right - begin) : convert<1>(grey, from, to, right - begin);
  }
  return true;
}

// The contrast that the mask sees at the pixel nearest to (x, y), and which pixel that is.
double MovingEdges::Impl::answer(double x, double y, double angle, int degree, double& at_x, double& at_y) {
  vpMeSite site;
  site.init(y - top, x - left, angle);
  at_x = site.j + left;
  at_y = site.i + top;
  return site.convolution(patch, &me) / gain[static_cast<std::size_t>(degree)];
}

MovedEdge MovingEdges::Impl::choose(const MovingEdge& edge, int half_width) const {
  const int range = std::clamp(edge.range_px, 1, max_range_px);
  const int steps = range + half_width;
  const bool line = edge.width_px >= 0.0;
  // A line shows two edges of opposite sense; the weaker one counts.
  const auto contrast_at = [&](int k) {
    const auto i = static_cast<std::size_t>(k + steps);
    if (!line) return answers[i];
    const double first = answers[i - static_cast<std::size_t>(half_width)];
    const double second = answers[i + static_cast<std::size_t>(half_width)];
    if (first * second >= 0.0) return 0.0;
    return std::copysign(std::min(std::abs(first), std::abs(second)), first);
  };
  MovedEdge best;
  double best_score = -1e9;
  for (int k = -range; k <= range; ++k) {
    const double contrast = contrast_at(k);
    if (std::abs(contrast) < least_contrast) continue;
    if (k > -range && std::abs(contrast_at(k - 1)) > std::abs(contrast)) continue;
    if (k < range && std::abs(contrast_at(k + 1)) >= std::abs(contrast)) continue;
    double score = std::abs(contrast);
    if (edge.contrast != 0.0) {
      const double ratio = contrast / edge.contrast;
      if (ratio < 1.0 - me.getMu1() || ratio > 1.0 + me.getMu2()) continue;
      score = -std::abs(1.0 - ratio);
    }
    if (score <= best_score) continue;
    best_score = score;
    const auto i = static_cast<std::size_t>(k + steps);
    const auto w = static_cast<std::size_t>(line ? half_width : 0);
    best = {true, 0.5 * (places[i - w] + places[i + w]), contrast};
  }
  return best;
}

MovingEdges::MovingEdges(double least_contrast) : impl_(std::make_unique<Impl>(least_contrast)) {}
MovingEdges::~MovingEdges() = default;
MovingEdges::MovingEdges(MovingEdges&&) noexcept = default;
MovingEdges& MovingEdges::operator=(MovingEdges&&) noexcept = default;

MovedEdge MovingEdges::follow(const Picture& picture, const MovingEdge& edge) const {
  assert(picture.channels == 1 || picture.channels == 3);
  const bool line = edge.width_px >= 0.0;
  const int half_width = line ? static_cast<int>(std::lround(std::max(0.5 * edge.width_px, least_half_width_px))) : 0;
  const int steps = std::clamp(edge.range_px, 1, max_range_px) + half_width;
  const bool inside = edge.pixel.x() >= 0.0 && edge.pixel.y() >= 0.0 && edge.pixel.x() < picture.width_px &&
                      edge.pixel.y() < picture.height_px;
  if (!inside || half_width > most_half_width_px) return {};
  if (!impl_->cut_out(picture, edge, steps)) return {};

  const double angle = std::atan2(edge.normal.y(), edge.normal.x());
  const int degree = static_cast<int>(std::lround(angle * 180.0 / pi) + 360) % 360;
  for (int k = -steps; k <= steps; ++k) {
    const Eigen::Vector2d asked = edge.pixel + k * edge.normal;
    Eigen::Vector2d at;
    const auto i = static_cast<std::size_t>(k + steps);
    impl_->answers[i] = impl_->answer(asked.x(), asked.y(), angle, degree, at.x(), at.y());
    impl_->places[i] = edge.normal.dot(at - edge.pixel);
  }
  return impl_->choose(edge, half_width);
}

}  // namespace hogline::vision
