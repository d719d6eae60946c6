#include "servo/stone_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hogline::servo::test {
namespace {

const StonePath draw({0.0, 28.0, 0.0, -2.1, 1.5}, {});

/// Handles along the draw, 30 a second; `half_turns`: the grip is taken by either end.
std::vector<HandleLook> handles(double spin, double loss, double noise_rad, bool half_turns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<HandleLook> looks;
  double angle = 0.4, rate = spin;
  for (int i = 0; i < 20000; ++i) {
    const double t = 1e-3 * i;
    angle += 1e-3 * rate;
    rate -= std::copysign(1e-3 * loss * 0.025 / std::max(0.001, speed_mps(draw.at(t).stone)), spin);
    if (i % 33 != 0) continue;
    const double turned = half_turns && random() % 2 == 0 ? std::numbers::pi : 0.0;
    looks.push_back({t, std::remainder(angle + noise_rad * normal(random) + turned, 2.0 * std::numbers::pi)});
  }
  return looks;
}

TEST(StoneRotation, IsMeasuredWithinItsSigmaWhicheverEndOfTheGripIsSeen) {
  double square = 0.0;
  int count = 0;
  for (const double spin : {-2.2, -1.57, -0.8, 0.9, 1.57, 2.2}) {
    for (const bool half_turns : {false, true}) {
      for (const double loss : {0.5, 1.0, 1.3}) {
        const StoneRotation rotation = rotation_of(handles(spin, loss, 0.08, half_turns, 7u + count), draw);
        ASSERT_TRUE(rotation.ok) << rotation.reason;
        EXPECT_NEAR(rotation.spin_radps, spin, 0.03);
        EXPECT_NEAR(rotation.loss, loss, 0.3);
        square += std::pow((rotation.spin_radps - spin) / rotation.sigma_radps, 2);
        ++count;
      }
    }
  }
  EXPECT_LT(std::sqrt(square / count), 1.5);
}

// Somebody stands in the way for two seconds; every eighth look is of something else; six looks a second.
TEST(StoneRotation, IsMeasuredThroughAGapAmongWildLooksAndAtLowRates) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-3.1, 3.1);
  for (const double spin : {-1.57, 0.6, 1.57, 3.0}) {
    for (const int each : {1, 5}) {
      const std::vector<HandleLook> all = handles(spin, 1.0, 0.1, true, 11);
      std::vector<HandleLook> looks;
      for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(each)) {
        if (all[i].after_s > 6.0 && all[i].after_s < 8.0) continue;
        looks.push_back(all[i]);
        if (looks.size() % 8 == 0) looks.back().handle_rad = any(random);
      }
      const StoneRotation rotation = rotation_of(looks, draw);
      ASSERT_TRUE(rotation.ok) << spin << ", each " << each << ": " << rotation.reason;
      EXPECT_NEAR(rotation.spin_radps, spin, std::max(0.03, 4.0 * rotation.sigma_radps));
      EXPECT_LT(rotation.sigma_radps, 0.05);
    }
  }
}

TEST(StoneRotation, SaysWhyItIsNotKnown) {
  std::vector<HandleLook> looks = handles(1.5, 1.0, 0.05, false, 1);
  const auto reason = [](const std::vector<HandleLook>& some) { return rotation_of(some, draw).reason; };
  EXPECT_EQ(reason({}), "the handle was seen too seldom");
  EXPECT_EQ(reason({looks.begin(), looks.begin() + 15}), "the handle was seen too shortly");
  // Half a second, eight seconds of nothing, half a second.
  std::vector<HandleLook> gap(looks.begin(), looks.begin() + 15);
  gap.insert(gap.end(), looks.begin() + 260, looks.begin() + 275);
  EXPECT_EQ(reason(gap), "the handle was hidden for too long: several rates agree with what was seen");
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-3.1, 3.1);
  for (HandleLook& look : looks) look.handle_rad = any(random);
  EXPECT_EQ(reason(looks), "the handle's directions do not make one turn");
}

}  // namespace
}  // namespace hogline::servo::test
