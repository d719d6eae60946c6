#include "hw/sim/sensor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

namespace hogline::hw::sim {
namespace {

constexpr int steps = 8192;  // of the table from the root of the electrons to the byte
constexpr std::size_t noise_period = 1U << 15U;
constexpr double headroom = 1.15;  // brighter than this is clipped all the same

// splitmix64
std::uint64_t mixed(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31);
}

// Standard normal numbers by Box and Muller: std::normal_distribution differs from library to library.
std::vector<float> normal_numbers(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return (static_cast<double>(random() >> 11U) + 0.5) * 0x1.0p-53; };
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

void roots(const float* light, const float* noise, int n, float electrons, float offset, float scale, float base,
           float growth, std::uint16_t* out) {
  constexpr auto last = static_cast<float>(steps - 1);
  for (int i = 0; i < n; ++i) {
    const float signal = light[i] * electrons + offset;
    const float root = scale * std::sqrt(signal > 0.0F ? signal : 0.0F);
    const float noisy = root + noise[i] * (base + growth * root);
    const float low = noisy > 0.0F ? noisy : 0.0F;
    const float high = low < last ? low : last;
    out[i] = static_cast<std::uint16_t>(static_cast<int>(high));
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
  if (model.noisy) noise_ = normal_numbers(noise_period + 3 * static_cast<std::size_t>(width_px), mixed(seed));
  else noise_.assign(noise_period + 3 * static_cast<std::size_t>(width_px), 0.0F);

  bytes_.resize(steps);
  const double bias = model.noisy ? 0.25 : 0.0;  // the mean of the squared noise of the root
  for (int i = 0; i < steps; ++i) {
    const double root = (i + 0.5) / scale;
    const double light = (root * root - read_variance - bias) / model.full_scale_electrons;
    bytes_[static_cast<std::size_t>(i)] = byte_of(light);
  }
}

std::uint8_t Sensor::byte_of(double light) const {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / model_.gamma)));
}

void Sensor::expose(const float* red, const float* green, const float* blue, std::uint64_t frame_seed, int row,
                    std::uint8_t* bgr, std::vector<std::uint16_t>& scratch) const {
  const auto w = static_cast<std::size_t>(width_px_);
  scratch.resize(3 * w);
  const float* noise = &noise_[mixed(frame_seed + mixed(static_cast<std::uint64_t>(row))) % noise_period];
  std::uint16_t* index = scratch.data();
  for (const float* plane : {blue, green, red}) {
    roots(plane, noise, width_px_, electrons_, read_variance_, scale_, noise_at_zero_, noise_growth_, index);
    noise += w;
    index += w;
  }
  const std::uint8_t* table = bytes_.data();
  const std::uint16_t* b = scratch.data();
  for (std::size_t i = 0; i < w; ++i) {
    bgr[3 * i] = table[b[i]];
    bgr[3 * i + 1] = table[b[i + w]];
    bgr[3 * i + 2] = table[b[i + 2 * w]];
  }
}

}  // namespace hogline::hw::sim
