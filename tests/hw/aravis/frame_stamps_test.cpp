// Stamps are the middle of the exposure, whatever the camera's clock, the wall clock and the link do.
#include "hw/aravis/frame_stamps.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/hw/aravis/scripted_source.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

// A camera exposes from `camera_start(k)` on; its packets come with a random delay after the read-out.
struct Stream {
  explicit Stream(CameraStampMeaning meaning) : config(test_config()) { config.stamp = meaning; }

  // The stamp's error of each of n frames.
  std::vector<double> errors_s(int n) {
    FrameStamps stamps(config);
    std::mt19937_64 random(7);
    std::exponential_distribution<double> delay_s(1.0 / mean_delay_s);
    std::vector<double> errors;
    for (int k = 0; k < n; ++k) {
      const Stamp start = Stamp{1000s} + k * Duration(16ms);
      const Stamp end = start + from_seconds(config.exposure_s);
      const Stamp first_packet = end + config.latency + from_seconds(delay_s(random));
      const Stamp taken = first_packet + 3ms;
      const Duration wall_at_taking = taken.time_since_epoch() + wall_less_steady(k, true);
      CameraBuffer buffer;
      buffer.wall = first_packet.time_since_epoch() + wall_less_steady(k, false);
      const Stamp stamped = config.stamp == CameraStampMeaning::exposure_end ? end : start;
      buffer.camera = from_seconds(seconds(stamped.time_since_epoch()) * (1.0 + drift)) + jump(k) - 5h;
      last = stamps.stamp_of(buffer, {taken, wall_at_taking});
      replaced += last.wall_replaced ? 1 : 0;
      jumps += last.camera_jumped ? 1 : 0;
      errors.push_back(seconds(last.middle - (start + from_seconds(0.5 * config.exposure_s))));
    }
    return errors;
  }

  AravisConfig config;
  double mean_delay_s = 0.0003;
  double drift = 0.0;
  std::function<Duration(int, bool)> wall_less_steady = [](int, bool) { return Duration(400000h); };
  std::function<Duration(int)> jump = [](int) { return Duration{}; };
  FrameStamp last;
  int replaced = 0;
  int jumps = 0;
};

double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

TEST(FrameStamps, by_arrival_err_by_the_packets_delay_and_never_early) {
  Stream stream(CameraStampMeaning::not_used);
  for (const double error_s : stream.errors_s(2000)) {
    EXPECT_GE(error_s, -1e-6);
    EXPECT_LE(error_s, 0.004);
  }
}

class ByCamera : public testing::TestWithParam<CameraStampMeaning> {};

TEST_P(ByCamera, are_ten_times_steadier_and_not_biased_by_the_mean_delay) {
  Stream stream(GetParam());
  stream.mean_delay_s = 0.002;  // a loaded machine
  auto errors = stream.errors_s(4000);
  errors.erase(errors.begin(), errors.begin() + 60);  // one second to find the quickest packet
  EXPECT_LT(spread(errors), 0.0002);
  for (const double error_s : errors) EXPECT_LT(std::abs(error_s), 0.0002);
  EXPECT_EQ(stream.jumps, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, ByCamera,
                         testing::Values(CameraStampMeaning::exposure_start, CameraStampMeaning::exposure_end));

TEST(FrameStamps, follow_a_camera_clock_that_drifts) {
  for (const double drift : {-100e-6, 100e-6}) {
    Stream stream(CameraStampMeaning::exposure_start);
    stream.drift = drift;
    auto errors = stream.errors_s(8000);  // two minutes: 13 ms of drift
    errors.erase(errors.begin(), errors.begin() + 60);
    for (const double error_s : errors) EXPECT_LT(std::abs(error_s), 0.0015) << drift;
  }
}

TEST(FrameStamps, a_camera_clock_that_jumps_is_told_and_costs_one_frame_at_most) {
  for (const Duration by : {Duration(-300s), Duration(300s)}) {
    Stream stream(CameraStampMeaning::exposure_start);
    stream.jump = [by](int k) { return k >= 500 ? by : Duration{}; };
    const auto errors = stream.errors_s(1000);
    EXPECT_EQ(stream.jumps, 1);
    for (std::size_t k = 100; k < errors.size(); ++k) EXPECT_LT(std::abs(errors[k]), 0.004) << k;
  }
}

TEST(FrameStamps, a_stepped_wall_clock_moves_no_stamp) {
  for (const Duration by : {Duration(-2h), Duration(300ms), Duration(2h)}) {
    Stream stream(CameraStampMeaning::not_used);
    // The worst moment: between the first packet of frame 500 and its taking.
    stream.wall_less_steady = [by](int k, bool at_taking) {
      return Duration(400000h) + (k > 500 || (k == 500 && at_taking) ? by : Duration{});
    };
    const auto errors = stream.errors_s(1000);
    for (std::size_t k = 0; k < errors.size(); ++k) EXPECT_LT(std::abs(errors[k]), 0.004) << k;
    EXPECT_EQ(stream.replaced, 1);
  }
}

TEST(FrameStamps, without_the_librarys_wall_clock_the_time_of_taking_serves) {
  FrameStamps stamps(test_config());
  CameraBuffer buffer;
  const FrameStamp stamp = stamps.stamp_of(buffer, {Stamp{50s}, 400000h});
  EXPECT_TRUE(stamp.wall_replaced);
  EXPECT_EQ(stamp.middle, Stamp{50s} - 2ms - 2ms);
}

TEST(ClockOffset, is_the_smallest_of_the_last_ten_seconds) {
  rc::check("against all of them", [] {
    const auto differences_us = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-5000, 5000)));
    ClockOffset offset;
    Stamp now{100s};
    std::vector<std::pair<Stamp, Duration>> all;
    for (const int us : differences_us) {
      now += 250ms;
      offset.add(now, us * Duration(1us));
      all.emplace_back(now, us * Duration(1us));
      // Whole seconds are forgotten at a time.
      Duration of_nine = Duration::max();
      Duration of_eleven = Duration::max();
      for (const auto& [stamp, difference] : all) {
        if (now - stamp <= 9s) of_nine = std::min(of_nine, difference);
        if (now - stamp <= 11s) of_eleven = std::min(of_eleven, difference);
      }
      RC_ASSERT(*offset.value() <= of_nine);
      RC_ASSERT(*offset.value() >= of_eleven);
    }
  });
}

}  // namespace
}  // namespace hogline::hw
