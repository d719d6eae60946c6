#include "vision/detect/stone_team.hpp"

#include <gtest/gtest.h>

namespace hogline::vision {
namespace {

struct Case {
  const char* what;
  std::array<float, 3> colour;  // red, green, blue against white ice
  Team team;
};

const Case cases[] = {
    {"red", {0.55F, 0.04F, 0.04F}, Team::first},
    {"dark red", {0.20F, 0.02F, 0.03F}, Team::first},
    {"a washed-out red", {0.60F, 0.22F, 0.20F}, Team::first},
    {"yellow", {0.75F, 0.55F, 0.05F}, Team::second},
    {"lemon yellow", {0.80F, 0.75F, 0.10F}, Team::second},
    {"blue", {0.03F, 0.10F, 0.50F}, Team::unknown},
    {"green", {0.05F, 0.40F, 0.08F}, Team::unknown},
    {"purple", {0.30F, 0.04F, 0.45F}, Team::unknown},
    {"white", {0.90F, 0.92F, 0.90F}, Team::unknown},
    {"black", {0.02F, 0.02F, 0.02F}, Team::unknown},
    {"half way between red and yellow", {0.70F, 0.32F, 0.03F}, Team::unknown},
};

TEST(StoneTeam, ByHueAndUnknownRatherThanAGuess) {
  for (const Case& c : cases) EXPECT_EQ(team_of(c.colour, {}).team, c.team) << c.what;
}

TEST(StoneTeam, TheColourOfALampDividesOutSoThatBrightnessDoesNotCount) {
  for (const float light : {0.3F, 1.0F, 1.4F}) {
    EXPECT_EQ(team_of({0.5F * light, 0.04F * light, 0.05F * light}, {}).team, Team::first) << light;
  }
}

TEST(StoneTeam, TheRigsHuesDecide) {
  const TeamHues blue_and_green{.first_rad = 4.19, .second_rad = 2.09};
  EXPECT_EQ(team_of({0.03F, 0.10F, 0.50F}, blue_and_green).team, Team::first);
  EXPECT_EQ(team_of({0.05F, 0.40F, 0.08F}, blue_and_green).team, Team::second);
  EXPECT_EQ(team_of({0.55F, 0.04F, 0.04F}, blue_and_green).team, Team::unknown);
}

}  // namespace
}  // namespace hogline::vision
