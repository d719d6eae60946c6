#include "vision/handle_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::random_board;
using hogline::testing::RandomBoard;

constexpr double degree = std::numbers::pi / 180.0;

/// Errors of all angles that were measured on some boards.
struct Tally {
  int stones = 0;
  int measured = 0;
  double sum = 0.0;
  double squares = 0.0;
  double squares_in_sigmas = 0.0;
  int wild = 0;  ///< more than four sigmas off

  void add(const StoneSighting& seen, double truth_rad) {
    ++stones;
    if (!seen.handle_rad) return;
    ++measured;
    const double error = std::remainder(*seen.handle_rad - truth_rad, std::numbers::pi);
    sum += error;
    squares += error * error;
    squares_in_sigmas += std::pow(error / seen.handle_sigma_rad, 2);
    wild += std::abs(error) > 4.0 * seen.handle_sigma_rad ? 1 : 0;
  }
  double bias_deg() const { return sum / measured / degree; }
  double rms_deg() const { return std::sqrt(squares / measured) / degree; }
  double in_sigmas() const { return std::sqrt(squares_in_sigmas / measured); }
};

StonesPercept look(const RandomBoard& board, const cv::Mat& picture) {
  StonesSetup setup;
  setup.camera = board.scene.setup;
  StoneFinder finder(setup);
  return finder.find(picture, {}, board.scene.eMc, board.scene.sheet_width_m);
}

void add_all(const RandomBoard& board, const StonesPercept& seen, Tally& tally) {
  for (const StoneSighting& s : seen.stones) {
    for (const auto& truth : board.scene.exposure.stones) {
      if (std::hypot(s.x_m - truth.x_m, s.y_m - truth.y_m) < 0.1) tally.add(s, truth.handle_rad);
    }
  }
}

RandomBoard bare(std::uint64_t seed) { return random_board(seed, {.most_stones = 0, .most_people = 0}); }

hw::sim::StoneLook stone_at(const Eigen::Vector2d& place, double handle_rad, bool red = true) {
  hw::sim::StoneLook stone;
  stone.x_m = place.x();
  stone.y_m = place.y();
  stone.handle_rad = handle_rad;
  if (!red) stone.plate = {0.72F, 0.52F, 0.03F};
  return stone;
}

// A row of stones across the sheet at a distance, turned by steps of 15 degrees.
RandomBoard row_at(std::uint64_t seed, double range_m) {
  RandomBoard board = bare(seed);
  const Eigen::Vector3d eye = board.scene.eMc.translation();
  for (int i = 0; i < 4; ++i) {
    const double x_m = -1.2 + 0.8 * i;
    const double y_m = eye.y() + std::sqrt(range_m * range_m - std::pow(x_m - eye.x(), 2));
    board.scene.exposure.stones.push_back(
        stone_at({x_m, y_m}, 45.0 * degree * i + 11.25 * degree * static_cast<double>(seed % 4), i % 2 == 0));
  }
  return board;
}

// Bias as well as spread, and a sigma that tells the truth, from near to far.
TEST(HandleAngle, AtAnyDistance) {
  struct Case {
    const char* what;
    double range_m;
    double rms_deg;
    double bias_deg;
    int least_measured;  // of 32
  };
  const Case cases[] = {{"in front of the robot", 3.0, 3.0, 1.0, 24},
                        {"in the house", 5.0, 5.0, 2.0, 24},
                        {"before the house", 7.0, 7.0, 3.0, 22},
                        {"near the hog line", 9.0, 12.0, 5.0, 18}};
  for (const Case& c : cases) {
    Tally tally;
    for (std::uint64_t seed = 301; seed < 309; ++seed) {
      const RandomBoard board = row_at(seed, c.range_m);
      add_all(board, look(board, hogline::testing::render(board.scene)), tally);
    }
    ASSERT_GE(tally.measured, c.least_measured) << c.what << ", of " << tally.stones;
    EXPECT_LT(tally.rms_deg(), c.rms_deg) << c.what;
    EXPECT_LT(std::abs(tally.bias_deg()), c.bias_deg) << c.what;
    EXPECT_LT(tally.in_sigmas(), 2.0) << c.what;
    EXPECT_GT(tally.in_sigmas(), 0.3) << c.what << ": the sigma is too large";
    EXPECT_LE(tally.wild, 1) << c.what;
  }
}

// Clumps, people, any sheet: what is hidden is not guessed at.
TEST(HandleAngle, OnRandomBoards) {
  Tally tally;
  for (std::uint64_t seed = 311; seed < 321; ++seed) {
    const RandomBoard board = random_board(seed);
    add_all(board, look(board, hogline::testing::render(board.scene)), tally);
  }
  EXPECT_GE(tally.measured, tally.stones / 2) << tally.stones;
  EXPECT_LE(tally.wild, 1 + tally.measured / 50) << tally.measured;
  EXPECT_LT(tally.in_sigmas(), 2.5);
}

TEST(HandleAngle, TheLampsColourDoesNotCount) {
  struct Lamp {
    const char* what;
    double blue, green, red;
  };
  for (const Lamp& lamp : {Lamp{"sodium", 0.45, 0.85, 1.0}, Lamp{"cold", 1.0, 0.9, 0.7}}) {
    Tally tally;
    for (std::uint64_t seed = 321; seed < 325; ++seed) {
      const RandomBoard board = row_at(seed, 4.5);
      cv::Mat picture = hogline::testing::render(board.scene);
      cv::multiply(picture, cv::Scalar(lamp.blue, lamp.green, lamp.red), picture);
      add_all(board, look(board, picture), tally);
    }
    ASSERT_GE(tally.measured, 10) << lamp.what << ", of " << tally.stones;
    EXPECT_LT(tally.rms_deg(), 6.0) << lamp.what;
    EXPECT_LE(tally.wild, 1) << lamp.what;
  }
}

// Somebody's legs, or a nearer stone, before the grip.
TEST(HandleAngle, AHiddenGripIsNotGuessedAt) {
  Tally tally;
  for (std::uint64_t seed = 331; seed < 337; ++seed) {
    RandomBoard board = bare(seed);
    const Eigen::Vector2d eye = board.scene.eMc.translation().head<2>();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d place(-1.0 + i, 1.5);
      board.scene.exposure.stones.push_back(stone_at(place, 0.7 * i + 0.1 * static_cast<double>(seed)));
      const Eigen::Vector2d towards = (eye - place).normalized();
      if (i == 0) {
        hw::sim::PersonLook person;
        person.x_m = place.x() + 0.35 * towards.x() + 0.08;
        person.y_m = place.y() + 0.35 * towards.y();
        board.scene.exposure.people.push_back(person);
      } else {
        const Eigen::Vector2d nearer = place + 0.30 * towards;
        board.scene.exposure.stones.push_back(stone_at(nearer, 0.4, i == 1));
      }
    }
    add_all(board, look(board, hogline::testing::render(board.scene)), tally);
  }
  EXPECT_GE(tally.measured, 8) << tally.stones;
  EXPECT_LE(tally.wild, 1) << tally.measured;
}

TEST(HandleAngle, WhereNoStoneIsNothingIsMeasured) {
  const RandomBoard board = bare(341);
  const cv::Mat picture = hogline::testing::render(board.scene);
  const ResponseCurve response(board.scene.setup.gamma);
  const WhiteLight ice(picture, response, 300);
  const SheetCamera camera(Lens(board.scene.setup.intrinsics), board.scene.eMc, board.scene.setup.ice);
  const StoneShape shape;
  const StonePicture seen{picture, response, ice, camera, shape};
  for (const double x_m : {-1.5, -0.7, 0.1, 0.9, 1.7, 40.0}) {
    StoneSighting stone;
    stone.x_m = x_m;
    stone.y_m = 0.5;
    stone.colour = {0.6F, 0.05F, 0.04F};
    const HandleAngle angle = handle_angle(seen, stone);
    EXPECT_FALSE(angle.ok) << x_m;
    EXPECT_FALSE(angle.reason.empty()) << x_m;
  }
}

}  // namespace
}  // namespace hogline::vision
