// The tee draw is solved on the known ice, whatever it is.
#include "src/campaign/tee_draw.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"

namespace hogline::campaign {
namespace {

TEST(TeeDraw, comes_to_rest_on_the_tee_on_any_ice_from_any_start) {
  const config::ScenarioFile file(config::embedded_file("scenarios/anywhere.yaml"), "anywhere.yaml");
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto scenario = file.draw(seed);
    const auto curl = seed % 2 == 0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
    const auto order = tee_draw(scenario, 0.5, 0.25, curl, 1.5);
    const auto rest = resting_place(scenario, 0.5, 0.25, order);
    EXPECT_NEAR(rest.x_m, 0.0, 0.001) << seed;
    EXPECT_NEAR(rest.y_m, 34.747, 0.001) << seed;
    EXPECT_GT(order.speed_mps, 1.8);
    EXPECT_LT(order.speed_mps, 2.5);
  }
}

}  // namespace
}  // namespace hogline::campaign
