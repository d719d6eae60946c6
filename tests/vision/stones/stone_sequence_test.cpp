// The stones of consecutive pictures: as good as the finder on each of them, whatever happens in between.
#include "vision/stone_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vision/stones/moving_board.hpp"

namespace hogline::vision {
namespace {

using testing::Happenings;
using testing::MovingBoard;
using testing::SequenceScore;

const StoneSighting* seen_at(const StonesPercept& seen, double x_m, double y_m) {
  for (const StoneSighting& s : seen.stones) {
    if (std::hypot(s.x_m - x_m, s.y_m - y_m) < 0.1) return &s;
  }
  return nullptr;
}

/// Follows a board's pictures.
class Followed {
 public:
  Followed(std::uint64_t seed, const Happenings& what) : board(seed, what), sequence(board.setup()) {}
  StonesPercept look(int k, const std::vector<StoneExpectation>& expected = {}) {
    return look(k, board.picture(k), expected);
  }
  StonesPercept look(int k, const cv::Mat& picture, const std::vector<StoneExpectation>& expected = {}) {
    const auto& scene = board.board().scene;
    return sequence.look(picture, board.stamp(k), scene.eMc, scene.sheet_width_m, expected);
  }
  MovingBoard board;
  StoneSequence sequence;
};

struct Case {
  const char* what;
  Happenings happenings;
};

// A stone is struck and somebody walks through the view: what the finder sees in a picture by itself is seen, nothing
// else, and the struck stone in every picture.
TEST(StoneSequence, LosesNothingThatTheFinderFinds) {
  const Case cases[] = {{"60 Hz", {.rate_hz = 60.0, .speed_mps = 2.5}},
                        {"30 Hz", {.rate_hz = 30.0}},
                        {"10 Hz", {.rate_hz = 10.0, .struck_at = 2}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    SequenceScore followed, found;
    for (const std::uint64_t seed : {5203U, 5204U}) {
      Followed run(seed, c.happenings);
      StoneFinder finder(run.board.setup());
      const auto& scene = run.board.board().scene;
      for (int k = 0; k < 12; ++k) {
        const cv::Mat picture = run.board.picture(k);
        const auto truth = run.board.at(k, true);
        followed.add(seed, k, truth, run.board.struck(), run.look(k, picture));
        EXPECT_EQ(run.sequence.diagnosis().whole, k == 0);
        found.add(seed, k, truth, run.board.struck(),
                  finder.find(picture, run.board.stamp(k), scene.eMc, scene.sheet_width_m));
      }
    }
    EXPECT_GE(followed.found, found.found) << followed.words();
    EXPECT_LE(followed.ghosts, found.ghosts) << followed.words();
    EXPECT_EQ(followed.struck_found, followed.struck) << followed.words();
    EXPECT_LT(followed.rms_m(), 1.5 * found.rms_m() + 0.001);
  }
}

// A stone that nobody expects comes into view, as one that was behind somebody.
TEST(StoneSequence, FindsAStoneThatWasNotThereBefore) {
  Followed run(5301, {.struck_at = -1, .walker = false});
  ASSERT_GE(run.board.board().stones.size(), 2U);
  const auto all = run.board.board();
  const hw::sim::SheetRenderer renderer(all.scene.setup.intrinsics, all.scene.setup.ice, all.scene.rink,
                                        all.scene.sensor, 1);
  hw::sim::Exposure without = all.scene.exposure;
  const auto late = all.stones.front();
  without.stones.erase(without.stones.begin());
  int waited = 0;
  bool seen = false;
  for (int k = 0; k < 12 && !seen; ++k) {
    cv::Mat picture;
    renderer.render(k < 3 ? without : all.scene.exposure, static_cast<std::uint64_t>(k), picture);
    seen = seen_at(run.look(k, picture), late.x_m, late.y_m) != nullptr;
    EXPECT_FALSE(seen && k < 3);
    waited += k >= 3 ? 1 : 0;
  }
  EXPECT_TRUE(seen);
  EXPECT_LE(waited, 7) << "0.2 s at 30 Hz, and a picture";
}

TEST(StoneSequence, AnExpectedStoneIsSeenAtOnce) {
  Followed run(5301, {.struck_at = -1, .walker = false});
  const auto all = run.board.board();
  const hw::sim::SheetRenderer renderer(all.scene.setup.intrinsics, all.scene.setup.ice, all.scene.rink,
                                        all.scene.sensor, 1);
  hw::sim::Exposure without = all.scene.exposure;
  const auto late = all.stones.front();
  without.stones.erase(without.stones.begin());
  cv::Mat picture;
  renderer.render(without, 0, picture);
  run.look(0, picture);
  const StoneExpectation expected{late.x_m + 0.1, late.y_m - 0.1, {0.004, 0.0, 0.004}};
  const StonesPercept seen = run.look(1, {expected});
  const StoneSighting* s = seen_at(seen, late.x_m, late.y_m);
  ASSERT_NE(s, nullptr);
  EXPECT_NEAR(s->x_m, late.x_m, 0.02);
  EXPECT_NEAR(s->y_m, late.y_m, 0.04);
}

// Somebody stands before all of it for a while: nothing is seen then, everything at once afterwards.
TEST(StoneSequence, WhatWasHiddenIsSeenAgainAtOnce) {
  Followed run(5302, {.struck_at = -1, .walker = false});
  const std::size_t before = run.look(0).stones.size();
  ASSERT_GE(before, 3U);
  const cv::Mat hidden(1200, 1600, CV_8UC3, cv::Scalar(90, 60, 200));
  for (int k = 1; k < 10; ++k) {
    const StonesPercept seen = run.look(k, hidden);
    EXPECT_TRUE(seen.ok);
    EXPECT_TRUE(seen.stones.empty());
  }
  EXPECT_EQ(run.look(10).stones.size(), before);
}

TEST(StoneSequence, APictureThatIsNoneIsRefusedAndNothingIsForgotten) {
  Followed run(5302, {.struck_at = -1, .walker = false});
  const std::size_t before = run.look(0).stones.size();
  for (const cv::Mat& picture :
       {cv::Mat(), cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(9)), cv::Mat(1200, 1600, CV_8UC1)}) {
    const StonesPercept seen = run.look(1, picture);
    EXPECT_FALSE(seen.ok);
    EXPECT_FALSE(seen.reason.empty());
  }
  EXPECT_EQ(run.look(2).stones.size(), before);
  EXPECT_FALSE(run.sequence.diagnosis().whole);
}

TEST(StoneSequence, AStampThatDoesNotGrowOrALongGapBeginsAnew) {
  Followed run(5302, {.struck_at = -1, .walker = false});
  run.look(0);
  run.look(3);
  EXPECT_FALSE(run.sequence.diagnosis().whole);
  run.look(3);
  EXPECT_TRUE(run.sequence.diagnosis().whole);
  run.look(40);
  EXPECT_TRUE(run.sequence.diagnosis().whole);
  run.sequence.forget();
  run.look(41);
  EXPECT_TRUE(run.sequence.diagnosis().whole);
}

}  // namespace
}  // namespace hogline::vision
