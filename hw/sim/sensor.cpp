#include "hw/sim/sensor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::hw::sim {
namespace {

constexpr int steps = 8192;  // of the table from the root of the electrons to the byte
constexpr std::size_t noise_period = 1U << 15U;
constexpr double headroom = 1.15;  // brighter than this is clipped all the same

// Standard normal numbers by Box and Muller: std::normal_distribution differs from library to library.
std::vector<float> normal_numbers(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return uniform_of(random()); };
  std::vector<float> numbers;
  numbers.reserve(count + 1);
  while (numbers.size() < count) {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    numbers.push_back(static_cast<float>(radius * std::cos(angle)));
    numbers.push_back(static_cast<float>(radius * std::sin(angle)));
  }
  numbers.resize(count);
  return numbers;
}

// The noise stays within the table's margin on either side, so that only the light needs a limit.
void roots(const float* light, const float* noise, int n, float electrons, float offset, float scale, float base,
           float growth, int margin, std::int32_t* out) {
  constexpr auto top = static_cast<float>(steps);
  for (int i = 0; i < n; ++i) {
    const float root = scale * std::sqrt(light[i] * electrons + offset);
    const float limited = root < top ? root : top;
    out[i] = static_cast<std::int32_t>(limited + noise[i] * (base + growth * limited) + static_cast<float>(margin));
  }
}

}  // namespace

Sensor::Sensor(const SensorModel& model, std::uint64_t seed, int width_px)
    : model_(model), width_px_(width_px), electrons_(static_cast<float>(model.full_scale_electrons)) {
  assert(model.gamma > 0.0 && model.full_scale_electrons > 0.0 && width_px > 0);
  const double read_variance = model.noisy ? model.read_noise_electrons * model.read_noise_electrons : 0.0;
  const double top = std::sqrt(headroom * model.full_scale_electrons + read_variance);
  const double scale = steps / top;
  read_variance_ = static_cast<float>(read_variance);
  scale_ = static_cast<float>(scale);
  noise_at_zero_ = static_cast<float>(model.noisy ? 0.5 * scale : 0.0);
  // Relative noise p moves the root by p / 2 of itself; added to the shot noise in quadrature, exact at full light.
  const double at_top = std::hypot(0.5, 0.5 * model.pebble_contrast * top);
  noise_growth_ = static_cast<float>(model.noisy ? (at_top - 0.5) / top : 0.0);
  if (model.noisy)
    noise_ = normal_numbers(noise_period + 3 * static_cast<std::size_t>(width_px), mixed_bits(seed));
  else
    noise_.assign(noise_period + 3 * static_cast<std::size_t>(width_px), 0.0F);

  const auto [lowest, highest] = std::minmax_element(noise_.begin(), noise_.end());
  const float farthest = std::max(-*lowest, *highest) * (noise_at_zero_ + noise_growth_ * static_cast<float>(steps));
  margin_ = static_cast<int>(farthest) + 2;

  const double bias = model.noisy ? 0.25 : 0.0;  // the mean of the squared noise of the root
  for (int i = -margin_; i < steps + margin_; ++i) {
    const double root = std::max(0.0, i + 0.5) / scale;
    bytes_.push_back(byte_of((root * root - read_variance - bias) / model.full_scale_electrons));
  }
}

std::uint8_t Sensor::byte_of(double light) const {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / model_.gamma)));
}

void Sensor::expose(const float* red, const float* green, const float* blue, std::uint64_t frame_seed, int row,
                    std::uint8_t* bgr, std::vector<std::int32_t>& scratch) const {
  const auto w = static_cast<std::size_t>(width_px_);
  scratch.resize(3 * w);
  const float* noise = &noise_[mixed_bits(frame_seed + mixed_bits(static_cast<std::uint64_t>(row))) % noise_period];
  std::int32_t* index = scratch.data();
  for (const float* plane : {blue, green, red}) {
    roots(plane, noise, width_px_, electrons_, read_variance_, scale_, noise_at_zero_, noise_growth_, margin_, index);
    noise += w;
    index += w;
  }
  const std::uint8_t* table = bytes_.data();
  const std::int32_t* b = scratch.data();
  for (std::size_t i = 0; i < w; ++i) {
    bgr[3 * i] = table[b[i]];
    bgr[3 * i + 1] = table[b[i + w]];
    bgr[3 * i + 2] = table[b[i + 2 * w]];
  }
}

}  // namespace hogline::hw::sim
