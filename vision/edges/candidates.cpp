#include "vision/edges/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

using Light = std::array<float, 3>;

// Running sums, so that the mean of any stretch costs two look-ups.
struct Sums {
  std::array<std::array<float, Profile::max_samples + 1>, 3> upto{};
  int channels;

  explicit Sums(const Profile& profile) : channels(profile.channels) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(profile.count); ++i) {
        upto[c][i + 1] = upto[c][i] + profile.light[c][i];
      }
    }
  }

  Light mean(int begin, int end) const {
    Light m{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      m[c] = (upto[c][static_cast<std::size_t>(end)] - upto[c][static_cast<std::size_t>(begin)]) /
             static_cast<float>(end - begin);
    }
    return m;
  }
};

float dot(const Light& a, const Light& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Light minus(const Light& a, const Light& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Median of the second differences' sizes: edges are few, noise is everywhere.
double noise_of(const Profile& profile) {
  std::array<float, Profile::max_samples> size{};
  if (profile.count < 5) return 0.0;
  const auto n = static_cast<std::size_t>(profile.count - 2);
  for (std::size_t i = 0; i < n; ++i) {
    float sum = 0.0F;
    for (std::size_t c = 0; c < static_cast<std::size_t>(profile.channels); ++c) {
      const auto& v = profile.light[c];
      const float d = v[i] - 2.0F * v[i + 1] + v[i + 2];
      sum += d * d;
    }
    size[i] = sum;
  }
  std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(n / 2),
                   size.begin() + static_cast<std::ptrdiff_t>(n));
  return std::sqrt(static_cast<double>(size[n / 2]) / 6.0);
}

void insert(Candidates& found, const Candidate& candidate) {
  int place = found.count;
  while (place > 0 && found.at[static_cast<std::size_t>(place - 1)].strength < candidate.strength) --place;
  if (place >= Candidates::max_count) return;
  found.count = std::min(found.count + 1, Candidates::max_count);
  for (int i = found.count - 1; i > place; --i) {
    found.at[static_cast<std::size_t>(i)] = found.at[static_cast<std::size_t>(i - 1)];
  }
  found.at[static_cast<std::size_t>(place)] = candidate;
}

// `at_sample(i)` is the strength at position(i) + shift.
Candidates maxima(const Profile& profile, const std::array<float, Profile::max_samples>& strength, int begin, int end,
                  double shift_px, double threshold) {
  Candidates found;
  for (int i = begin + 1; i + 1 < end; ++i) {
    const float here = strength[static_cast<std::size_t>(i)];
    const float before = strength[static_cast<std::size_t>(i - 1)];
    const float after = strength[static_cast<std::size_t>(i + 1)];
    if (!(here > before && here >= after && here > threshold)) continue;
    const double bend = static_cast<double>(before - 2.0F * here + after);
    const double peak = bend < 0.0 ? 0.5 * static_cast<double>(before - after) / bend : 0.0;
    insert(found, {profile.position(i) + peak * profile.step_px + shift_px, static_cast<double>(here)});
  }
  return found;
}

constexpr double floor_strength = 0.01;  // a hundredth of full light: below, eight bits say nothing

}  // namespace

Candidates find_steps(const Profile& profile, double blur_px) {
  const Sums sums(profile);
  const int h = std::max(2, static_cast<int>(std::lround(1.5 * blur_px / profile.step_px)));
  std::array<float, Profile::max_samples> strength{};
  for (int i = h; i + h <= profile.count; ++i) {
    const Light d = minus(sums.mean(i, i + h), sums.mean(i - h, i));
    strength[static_cast<std::size_t>(i)] = std::sqrt(dot(d, d));
  }
  const double noise = noise_of(profile) * std::sqrt(2.0 / h);
  return maxima(profile, strength, h, profile.count - h + 1, -0.5 * profile.step_px,
                std::max(floor_strength, 4.0 * noise));
}

Candidates find_ridges(const Profile& profile, double width_px, double blur_px) {
  const Sums sums(profile);
  const double seen_px = std::max(width_px, 1.5 * blur_px);
  const int core = std::max(1, static_cast<int>(std::lround(0.5 * seen_px / profile.step_px)));
  const int gap = std::max(0, static_cast<int>(std::lround(blur_px / profile.step_px)));
  const int flank = std::max(2, static_cast<int>(std::lround(2.0 * blur_px / profile.step_px)));
  const int reach = core + gap + flank;
  std::array<float, Profile::max_samples> strength{};
  for (int i = reach; i + reach < profile.count; ++i) {
    const Light middle = sums.mean(i - core, i + core + 1);
    const Light left = minus(middle, sums.mean(i - reach, i - core - gap));
    const Light right = minus(middle, sums.mean(i + core + gap + 1, i + reach + 1));
    const float along = dot(left, right);
    if (along <= 0.0F) continue;
    const float both = std::min(dot(left, left), dot(right, right));
    strength[static_cast<std::size_t>(i)] = std::sqrt(std::min(along, both));
  }
  const double noise = noise_of(profile) * std::sqrt(1.0 / flank + 1.0 / (2 * core + 1));
  return maxima(profile, strength, reach, profile.count - reach, 0.0, std::max(floor_strength, 4.0 * noise));
}

}  // namespace hogline::vision
