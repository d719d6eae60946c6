// The fault line of a camera: what the library can hand out, and what becomes of it.
#include "hw/aravis/camera_feed.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/hw/aravis/scripted_source.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

struct Bench {
  explicit Bench(int count = 100) {
    for (int k = 0; k < count; ++k) source.arrivals.push_back(arrival_of(k, begin));
  }
  void run(Duration span) {
    const Stamp until = clocks.steady + span;
    while (clocks.steady < until) {
      const Stamp before = clocks.steady;
      if (auto frame = feed.step(20ms)) frames.push_back(*frame);
      if (feed.state().error && !failed_at) failed_at = clocks.steady;
      if (clocks.steady == before) clocks.advance(5ms);  // closed: the thread would sleep
    }
  }
  const FeedCounters& counters() const { return feed.state().counters; }

  TestClocks clocks;
  Stamp begin = clocks.steady + 10ms;
  ScriptedSource source{clocks};
  CameraFeed feed{source, test_config(), [this] { return clocks.now(); }};
  std::vector<Frame> frames;
  std::optional<Stamp> failed_at;
};

TEST(CameraFeed, gives_every_frame_with_the_middle_of_its_exposure) {
  Bench bench;
  bench.run(100 * 16ms);
  ASSERT_EQ(bench.frames.size(), 100U);
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(bench.frames[static_cast<std::size_t>(k)].id, static_cast<std::uint64_t>(1 + k));
    EXPECT_NEAR(seconds(bench.frames[static_cast<std::size_t>(k)].stamp - middle_of(k, bench.begin)), 0.0, 1e-6);
  }
  EXPECT_EQ(bench.counters().lost, 0U);
  EXPECT_FALSE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().phase, FeedPhase::streaming);
  EXPECT_EQ(bench.feed.state().identity.serial, "S1");
}

TEST(CameraFeed, a_slow_taker_gets_the_newest_frame_only) {
  Bench bench;
  bench.run(10 * 16ms);
  bench.clocks.advance(50ms);  // shorter than the silence that is a fault
  bench.frames.clear();
  const auto frame = bench.feed.step(0ms);
  ASSERT_TRUE(frame);
  EXPECT_LT(seconds(bench.clocks.steady - frame->stamp), 0.030);
  EXPECT_GE(bench.counters().overtaken, 2U);
  EXPECT_EQ(bench.counters().lost, 0U) << "dropped for a newer one is not lost";
}

TEST(CameraFeed, starts_anew_when_a_start_gives_no_frame) {
  Bench bench(200);
  bench.source.mute_starts = 2;
  bench.run(2s);
  EXPECT_EQ(bench.source.starts, 3);
  EXPECT_EQ(bench.counters().mute_starts, 2U);
  EXPECT_FALSE(bench.feed.state().error) << "two mute starts are the library's way";
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_LT(seconds(bench.frames.front().stamp - bench.begin), 1.1) << "two deadlines of 0.5 s";
}

TEST(CameraFeed, three_mute_starts_are_an_error_and_it_goes_on_trying) {
  Bench bench(0);
  bench.run(5s);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, DeviceErrorKind::timeout);
  EXPECT_NEAR(seconds(*bench.failed_at - bench.begin), 1.5, 0.1);
  EXPECT_GE(bench.source.starts, 8);
}

TEST(CameraFeed, frames_that_stop_are_an_error_within_the_limit_and_come_back_without_clearing_it) {
  Bench bench(200);
  auto& script = bench.source.arrivals;
  script.erase(script.begin() + 50, script.begin() + 100);
  bench.run(200 * 16ms);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, DeviceErrorKind::timeout);
  EXPECT_EQ(bench.feed.state().error->device, "low camera");
  const Stamp last_good = arrival_of(49, bench.begin).at;
  EXPECT_LE(seconds(*bench.failed_at - last_good), 0.060 + 0.021);
  EXPECT_EQ(bench.counters().outages, 1U);
  EXPECT_EQ(bench.feed.state().phase, FeedPhase::streaming) << "recovered by itself";
  EXPECT_GT(bench.frames.back().stamp, arrival_of(150, bench.begin).at);
  bench.feed.rearm();
  EXPECT_FALSE(bench.feed.state().error);
}

TEST(CameraFeed, incomplete_buffers_are_dropped_and_counted) {
  Bench bench;
  for (int k = 10; k < 100; k += 10) bench.source.arrivals[static_cast<std::size_t>(k)].complete = false;
  bench.run(100 * 16ms);
  EXPECT_EQ(bench.frames.size(), 91U);
  EXPECT_EQ(bench.counters().incomplete, 9U);
  EXPECT_EQ(bench.counters().lost, 0U);
  EXPECT_FALSE(bench.feed.state().error);
}

TEST(CameraFeed, only_incomplete_buffers_are_silence) {
  Bench bench;
  for (std::size_t k = 30; k < 100; ++k) bench.source.arrivals[k].complete = false;
  bench.run(60 * 16ms);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, DeviceErrorKind::timeout);
}

TEST(CameraFeed, a_gap_in_the_numbers_is_counted) {
  Bench bench;
  bench.source.arrivals.erase(bench.source.arrivals.begin() + 20, bench.source.arrivals.begin() + 22);
  bench.run(100 * 16ms);
  EXPECT_EQ(bench.counters().lost, 2U);
  EXPECT_EQ(bench.frames[20].id, bench.frames[19].id + 3);
  EXPECT_FALSE(bench.feed.state().error);
}

TEST(CameraFeed, is_told_when_the_camera_is_taken_away) {
  Bench bench(200);
  bench.run(20 * 16ms);
  bench.source.lost = true;
  bench.run(25ms);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, DeviceErrorKind::disconnected);
  bench.run(500ms);
  EXPECT_EQ(bench.feed.state().phase, FeedPhase::streaming) << "opened again";
}

TEST(CameraFeed, a_camera_that_is_not_there_is_an_error_and_is_found_when_it_comes) {
  Bench bench(200);
  for (int i = 0; i < 5; ++i) {
    bench.source.start_faults.push_back(SourceFault{DeviceErrorKind::disconnected, "no camera with serial number S1"});
  }
  bench.run(500ms);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, DeviceErrorKind::disconnected);
  EXPECT_LE(bench.source.starts, 4) << "tried every 200 ms, not in a loop";
  bench.run(2s);
  EXPECT_EQ(bench.feed.state().phase, FeedPhase::streaming);
}

struct Wrong {
  const char* description;
  std::function<void(Arrival&)> change;  // of frame 30
  DeviceErrorKind kind;
  const char* says;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.description; }

class WrongFrames : public testing::TestWithParam<Wrong> {};

TEST_P(WrongFrames, are_an_error_at_once_and_are_not_given) {
  Bench bench;
  GetParam().change(bench.source.arrivals[30]);
  bench.run(100 * 16ms);
  ASSERT_TRUE(bench.feed.state().error);
  EXPECT_EQ(bench.feed.state().error->kind, GetParam().kind);
  EXPECT_NE(bench.feed.state().error->what.find(GetParam().says), std::string::npos) << bench.feed.state().error->what;
  EXPECT_EQ(*bench.failed_at, arrival_of(30, bench.begin).at);
  EXPECT_EQ(bench.frames.size(), 99U);
  EXPECT_EQ(bench.counters().refused, 1U);
}

INSTANTIATE_TEST_SUITE_P(
    Table, WrongFrames,
    testing::Values(Wrong{"another size", [](Arrival& a) { a.width_px = 32; }, DeviceErrorKind::implausible, "32x48"},
                    Wrong{"half the size in the same bytes", [](Arrival& a) { a.height_px = 24; },
                          DeviceErrorKind::implausible, "64x24"},
                    Wrong{"a format nobody can use", [](Arrival& a) { a.format = 0x01100007; },
                          DeviceErrorKind::implausible, "0x01100007"},
                    Wrong{"fewer bytes than the format needs", [](Arrival& a) { a.format = 0x02180014; },
                          DeviceErrorKind::implausible, "RGB8"},
                    Wrong{"the same number again", [](Arrival& a) { a.id -= 1; }, DeviceErrorKind::implausible,
                          "numbers go back"},
                    Wrong{"time going back", [](Arrival& a) { a.transfer = 40ms; }, DeviceErrorKind::implausible,
                          "before the last"}));

TEST(CameraFeed, numbers_go_on_growing_over_a_restart) {
  Bench bench(100);
  for (std::size_t k = 50; k < 100; ++k) bench.source.arrivals[k].id = k - 49;
  bench.source.arrivals.erase(bench.source.arrivals.begin() + 50, bench.source.arrivals.begin() + 60);
  bench.run(100 * 16ms);
  for (std::size_t i = 1; i < bench.frames.size(); ++i) EXPECT_GT(bench.frames[i].id, bench.frames[i - 1].id) << i;
  EXPECT_GE(bench.frames.size(), 80U);
}

}  // namespace
}  // namespace hogline::hw
