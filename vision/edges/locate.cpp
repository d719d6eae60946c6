#include "vision/edges/locate.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr int max_half_kernel = 60;

// A filter sampled at the profile's step, of unit energy, and how fast its peak falls off (for sigma).
struct Kernel {
  int half = 0;
  std::array<float, 2 * max_half_kernel + 1> weight{};
};

void normalise(Kernel& kernel, bool remove_mean) {
  const int n = 2 * kernel.half + 1;
  float mean = 0.0F;
  for (int i = 0; i < n; ++i) mean += kernel.weight[static_cast<std::size_t>(i)];
  mean /= static_cast<float>(n);
  float energy = 0.0F;
  for (int i = 0; i < n; ++i) {
    float& w = kernel.weight[static_cast<std::size_t>(i)];
    if (remove_mean) w -= mean;
    energy += w * w;
  }
  const float scale = 1.0F / std::sqrt(energy);
  for (int i = 0; i < n; ++i) kernel.weight[static_cast<std::size_t>(i)] *= scale;
}

// The derivative of a Gaussian: the matched filter for the place of a blurred step, odd about it.
Kernel edge_kernel(double blur_px) {
  Kernel kernel;
  kernel.half = std::min(max_half_kernel, static_cast<int>(std::ceil(3.0 * blur_px / Profile::step_px)));
  for (int i = -kernel.half; i <= kernel.half; ++i) {
    const double t = i * Profile::step_px / blur_px;
    kernel.weight[static_cast<std::size_t>(i + kernel.half)] = static_cast<float>(t * std::exp(-0.5 * t * t));
  }
  normalise(kernel, false);
  return kernel;
}

// A box of the line's width under Gaussian blur, less its mean over one more width of ice to each side.
Kernel line_kernel(double width_px, double blur_px) {
  Kernel kernel;
  const double reach_px = 0.5 * width_px + 2.5 * blur_px + 0.5 * std::max(width_px, 1.0);
  kernel.half = std::min(max_half_kernel, static_cast<int>(std::ceil(reach_px / Profile::step_px)));
  const double root = std::sqrt(2.0) * blur_px;
  for (int i = -kernel.half; i <= kernel.half; ++i) {
    const double t = i * Profile::step_px;
    kernel.weight[static_cast<std::size_t>(i + kernel.half)] =
        static_cast<float>(0.5 * (std::erf((t + 0.5 * width_px) / root) - std::erf((t - 0.5 * width_px) / root)));
  }
  normalise(kernel, true);
  return kernel;
}

struct Response {
  int begin = 0;  // first lag's profile index
  int size = 0;
  std::array<std::array<float, Profile::max_samples>, 3> channel{};
  std::array<float, Profile::max_samples> strength{};
};

void correlate(const Profile& profile, const Kernel& kernel, double search_px, Response& response) {
  const int centre = profile.size / 2;
  const int reach = std::min(static_cast<int>(std::ceil(search_px / Profile::step_px)) + 1, centre - kernel.half);
  response.begin = centre - reach;
  response.size = std::max(0, 2 * reach + 1);
  for (int k = 0; k < response.size; ++k) {
    float strength = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) {
      const float* light = profile.light[c].data() + response.begin + k - kernel.half;
      float sum = 0.0F;
      for (int i = 0; i <= 2 * kernel.half; ++i) sum += kernel.weight[static_cast<std::size_t>(i)] * light[i];
      response.channel[c][static_cast<std::size_t>(k)] = sum;
      strength += sum * sum;
    }
    response.strength[static_cast<std::size_t>(k)] = strength;
  }
}

// The noise of a filter of unit energy, from the profile's second differences: paint varies slowly, noise does not.
// Bilinear samples at half a pixel are correlated: of white noise s they have a second difference of about 0.82 s.
float noise_of(const Profile& profile, const std::array<float, 3>& direction) {
  std::array<float, Profile::max_samples> difference{};
  const int n = profile.size - 4;
  const auto along = [&](int i) {
    float v = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) v += direction[c] * profile.light[c][static_cast<std::size_t>(i)];
    return v;
  };
  for (int i = 0; i < n; ++i) {
    difference[static_cast<std::size_t>(i)] = std::abs(along(i) - 2.0F * along(i + 2) + along(i + 4));
  }
  const auto middle = difference.begin() + n / 2;
  std::nth_element(difference.begin(), middle, difference.begin() + n);
  // Median of |x| is 0.6745 s; three independent samples with weights 1 -2 1 give sqrt(6) s.
  return *middle / (0.6745F * 2.449F);
}

Localisation peak_of(const Profile& profile, const Response& response, double blur_px) {
  Localisation result;
  if (response.size < 3) {
    result.reason = "the profile is too short";
    return result;
  }
  const auto first = response.strength.begin() + 1;
  const auto best = std::max_element(first, response.strength.begin() + response.size - 1);
  const auto k = static_cast<std::size_t>(best - response.strength.begin());
  const float peak = std::sqrt(*best);
  if (!(peak > 0.0F) || !std::isfinite(peak)) {
    result.reason = "no contrast";
    return result;
  }
  for (std::size_t c = 0; c < 3; ++c) result.contrast[c] = response.channel[c][k] / peak;
  const auto along = [&](std::size_t i) {
    float v = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) v += result.contrast[c] * response.channel[c][i];
    return v;
  };
  const double a = along(k - 1);
  const double b = along(k);
  const double d = along(k + 1);
  const double curvature = a - 2.0 * b + d;
  if (curvature >= 0.0) {
    result.reason = "the strongest place is at the search's border";
    return result;
  }
  const double shift = std::clamp(0.5 * (a - d) / curvature, -0.6, 0.6);
  result.offset_px = profile.offset_px(response.begin + static_cast<double>(k) + shift);

  constexpr float quantisation = 0.0005F;  // an eighth of an 8-bit step: noise is never taken for nothing
  const float noise = std::hypot(noise_of(profile, result.contrast), quantisation);
  result.snr = static_cast<double>(peak / noise);
  // The place's noise is that of the response's slope over its curvature; samples at half a pixel count for half.
  const double curvature_per_px2 = -curvature / (Profile::step_px * Profile::step_px);
  result.sigma_px = std::sqrt(2.0) * static_cast<double>(noise) * 1.22 / blur_px / curvature_per_px2;
  result.sigma_px = std::clamp(result.sigma_px, 0.005, 3.0 * blur_px);
  for (float& c : result.contrast) c *= peak;
  if (result.snr < 6.0) {
    result.reason = "no contrast above the noise";
    return result;
  }
  result.ok = true;
  return result;
}

}  // namespace

Localisation locate_edge(const Profile& profile, double search_px, double blur_px) {
  Response response;
  correlate(profile, edge_kernel(blur_px), search_px, response);
  return peak_of(profile, response, blur_px);
}

Localisation locate_line(const Profile& profile, double search_px, double width_px, double blur_px) {
  Response response;
  correlate(profile, line_kernel(width_px, blur_px), search_px, response);
  return peak_of(profile, response, blur_px);
}

}  // namespace hogline::vision
