// A tracked frame takes no memory from the heap, whoever asks for it: hogline, OpenCV, ViSP, Eigen or the library.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "tests/support/random_board.hpp"
#include "tests/support/run_sequence.hpp"
#include "tests/support/turning_sequence.hpp"
#include "vision/low_sequence.hpp"
#include "vision/near_sequence.hpp"
#include "vision/stones.hpp"

namespace {

std::atomic<long> asked_for{0};  // times that somebody asked for memory

}  // namespace

// The C library's own functions under other names: what follows stands in for malloc and its kin in this program.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  asked_for.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  asked_for.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  asked_for.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  asked_for.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** place, std::size_t alignment, std::size_t size) {
  *place = memalign(alignment, size);
  return *place == nullptr ? ENOMEM : 0;
}
}

namespace hogline::vision {
namespace {

using hogline::testing::turning_move_among_people;
using hogline::testing::TurningFrame;
using hogline::testing::TurningSequence;

TEST(Allocation, IsCounted) {
  const long before = asked_for;
  const std::vector<double> some(1000, 1.0);
  const cv::Mat picture(40, 30, CV_8UC3);
  EXPECT_GE(asked_for - before, 2);
  EXPECT_EQ(some.size() + picture.total(), 2200U);
}

TEST(Allocation, DoesNotHappenInTrackedFrames) {
  const TurningSequence sequence(turning_move_among_people(2));
  std::vector<TurningFrame> frames;
  for (int k = 20; k < 28; ++k) frames.push_back(sequence.frame(k));
  NearSequence near(sequence.setup());

  constexpr int warm_up = 20;
  constexpr int counted = 50;
  const int last = static_cast<int>(frames.size()) - 1;
  double yaw_rad = frames[0].body.yaw_rad;
  for (int k = 0; k < warm_up + counted; ++k) {
    const int swing = k % (2 * last);  // to and fro
    const TurningFrame& frame = frames[static_cast<std::size_t>(swing <= last ? swing : 2 * last - swing)];
    const double turned_rad = frame.body.yaw_rad - yaw_rad;
    yaw_rad = frame.body.yaw_rad;
    const Stamp stamp{from_seconds(k / 60.0)};

    const long before = asked_for;
    const SheetPosePercept& percept = near.step(frame.bgr, stamp, turned_rad);
    const long during = asked_for - before;

    ASSERT_TRUE(percept.ok) << percept.reason;
    if (k == 0) continue;
    ASSERT_TRUE(near.diagnosis().tracked) << "frame " << k << ": " << near.diagnosis().lost;
    if (k >= warm_up) {
      EXPECT_EQ(during, 0) << "frame " << k;
    }
  }
}

TEST(Allocation, DoesNotHappenInTheTrackedFramesOfARun) {
  const hogline::testing::RunSequence run{hogline::testing::RunMove{}};
  LowSequence low(run.setup());
  constexpr int warm_up = 15;
  for (int k = 0; k < run.size(); ++k) {
    const hogline::testing::RunFrame frame = run.frame(k);

    const long before = asked_for;
    const SheetPosePercept& percept = low.step(frame.bgr, frame.stamp);
    const long during = asked_for - before;

    ASSERT_TRUE(percept.ok) << percept.reason;
    if (k == 0) continue;
    ASSERT_TRUE(low.diagnosis().tracked) << "frame " << k << ": " << low.diagnosis().lost;
    if (k >= warm_up) {
      EXPECT_EQ(during, 0) << "frame " << k << (low.diagnosis().blind ? ", without the hog line" : "");
    }
  }
}

// Found from nothing, stones take some: short lists and reasons of candidates. None for each pixel or place, and no
// more from picture to picture.
TEST(Allocation, IsRareWhereStonesAreFound) {
  hogline::testing::RandomBoard board;
  for (std::uint64_t seed = 1; board.stones.size() != 8; ++seed) board = hogline::testing::random_board(seed);
  const cv::Mat picture = hogline::testing::render(board.scene);
  StonesSetup setup;
  setup.camera = board.scene.setup;
  StoneFinder finder(setup);
  long last = 0;
  for (int k = 0; k < 4; ++k) {
    const long before = asked_for;
    const StonesPercept percept = finder.find(picture, Stamp{}, board.scene.eMc, board.scene.sheet_width_m);
    const long during = asked_for - before;
    ASSERT_TRUE(percept.ok) << percept.reason;
    ASSERT_GE(percept.stones.size(), 6U);
    if (k > 0) {
      EXPECT_LE(during, 100 + 20L * percept.candidates) << "picture " << k;
    }
    if (k > 1) {
      EXPECT_LE(during, last) << "picture " << k;
    }
    last = during;
  }
}

}  // namespace
}  // namespace hogline::vision
