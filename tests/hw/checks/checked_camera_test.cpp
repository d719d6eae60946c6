// Whatever is wrong with a frame is a device error with the first one, and the frame is not given.
#include "hw/checks/checked_camera.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <opencv2/core.hpp>

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

constexpr Duration period = 16ms;
constexpr Duration latency = 14ms;

cv::Mat noisy(std::uint64_t seed, double mean = 120.0) {
  cv::Mat picture(48, 64, CV_8UC3);
  cv::RNG random(seed + 1);
  random.fill(picture, cv::RNG::NORMAL, cv::Scalar::all(mean), cv::Scalar::all(3.0));
  return picture;
}

// Gives what it was handed, when its time has come.
class ScriptedCamera final : public Camera {
 public:
  struct Delivery {
    Stamp at;
    Frame frame;
  };
  std::optional<Frame> latest(Stamp now) override {
    std::optional<Frame> newest;
    while (!script.empty() && script.front().at <= now) {
      newest = script.front().frame;
      script.pop_front();
    }
    return newest;
  }
  std::optional<DeviceError> error() const override { return own_error; }
  void rearm() override { own_error.reset(); }

  std::deque<Delivery> script;
  std::optional<DeviceError> own_error;
};

Stamp at(Duration t) { return Stamp{10s + t}; }

Frame frame_of(int k) {
  return {noisy(static_cast<std::uint64_t>(k)), at(k * period), static_cast<std::uint64_t>(100 + k)};
}

struct Bench {
  explicit Bench(int frames) {
    for (int k = 0; k < frames; ++k) camera.script.push_back({at(k * period) + latency, frame_of(k)});
  }
  // Asks every 5 ms, as a control loop does; returns how many frames were given.
  int run(Duration from, Duration to) {
    int given = 0;
    for (Duration t = from; t < to; t += 5ms) {
      if (const auto frame = checked.latest(at(t))) ++given;
      if (checked.error() && !failed_at) failed_at = t;
    }
    return given;
  }

  ScriptedCamera camera;
  CheckedCamera checked{camera,
                        {.name = "low camera", .max_age = 60ms, .silence_limit = 80ms, .first_frame_limit = 500ms}};
  std::optional<Duration> failed_at;
};

TEST(CheckedCamera, gives_every_good_frame) {
  Bench bench(60);
  EXPECT_EQ(bench.run(-1ms, 60 * period), 60);
  EXPECT_FALSE(bench.checked.error()) << bench.checked.error()->what;
  EXPECT_EQ(bench.checked.counters().refused, 0U);
}

struct Fault {
  const char* description;
  std::function<void(std::deque<ScriptedCamera::Delivery>&)> inject;  // into a script of 60 frames, at frame 30
  DeviceErrorKind kind;
  const char* says;
  Duration detected_within;  // of frame 30's due arrival
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.description; }

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, are_errors_at_once_and_stay) {
  const Fault& fault = GetParam();
  Bench bench(60);
  fault.inject(bench.camera.script);
  bench.run(0ms, 70 * period);
  ASSERT_TRUE(bench.checked.error());
  EXPECT_EQ(bench.checked.error()->kind, fault.kind) << bench.checked.error()->what;
  EXPECT_NE(bench.checked.error()->what.find(fault.says), std::string::npos) << bench.checked.error()->what;
  EXPECT_EQ(bench.checked.error()->device, "low camera");
  const Duration due = 30 * period + latency;
  EXPECT_GE(*bench.failed_at, due - 5ms);
  EXPECT_LE(*bench.failed_at, due + fault.detected_within);
  EXPECT_TRUE(bench.checked.error()) << "latched, though good frames came again";
}

INSTANTIATE_TEST_SUITE_P(Table, Faults,
                         testing::Values(Fault{"black", [](auto& s) { s[30].frame.bgr = noisy(1, 1.0); },
                                               DeviceErrorKind::implausible, "black", 5ms},
                                         Fault{"saturated", [](auto& s) { s[30].frame.bgr = noisy(1, 300.0); },
                                               DeviceErrorKind::implausible, "saturated", 5ms},
                                         Fault{"frozen picture with new stamps",
                                               [](auto& s) { s[30].frame.bgr = s[29].frame.bgr.clone(); },
                                               DeviceErrorKind::implausible, "frozen", 5ms},
                                         Fault{"the old frame again, newly numbered",
                                               [](auto& s) {
                                                 s[30].frame.bgr = s[29].frame.bgr;
                                                 s[30].frame.stamp = s[29].frame.stamp;
                                               },
                                               DeviceErrorKind::implausible, "repeats itself", 5ms},
                                         Fault{"time goes back", [](auto& s) { s[30].frame.stamp -= 3 * period; },
                                               DeviceErrorKind::implausible, "before the last", 5ms},
                                         Fault{"number goes back", [](auto& s) { s[30].frame.id = 7; },
                                               DeviceErrorKind::implausible, "numbers", 5ms},
                                         Fault{"stamp from the future", [](auto& s) { s[30].frame.stamp += 1s; },
                                               DeviceErrorKind::implausible, "ahead", 5ms},
                                         Fault{"late frames",
                                               [](auto& s) {
                                                 for (std::size_t k = 30; k < s.size(); ++k) s[k].at += 55ms;
                                               },
                                               DeviceErrorKind::timeout, "after its exposure", 60ms},
                                         Fault{"frames stop", [](auto& s) { s.erase(s.begin() + 30, s.end()); },
                                               DeviceErrorKind::timeout, "no frame", 80ms}));

TEST(CheckedCamera, a_gap_in_the_numbers_is_no_error_of_its_own) {
  Bench bench(60);
  bench.camera.script.erase(bench.camera.script.begin() + 30, bench.camera.script.begin() + 33);
  EXPECT_EQ(bench.run(-1ms, 60 * period), 57);
  EXPECT_FALSE(bench.checked.error());
}

TEST(CheckedCamera, no_first_frame_is_an_error_only_after_its_own_limit) {
  Bench bench(0);
  bench.run(0ms, 495ms);
  EXPECT_FALSE(bench.checked.error());
  bench.run(495ms, 600ms);
  ASSERT_TRUE(bench.checked.error());
  EXPECT_EQ(bench.checked.error()->kind, DeviceErrorKind::timeout);
}

TEST(CheckedCamera, what_was_exposed_before_anybody_asked_is_passed_over) {
  Bench bench(60);
  for (std::size_t k = 0; k < 30; ++k) bench.camera.script[k].frame.bgr = noisy(k, 1.0);  // the head is folded
  bench.run(30 * period, 60 * period);
  EXPECT_FALSE(bench.checked.error()) << bench.checked.error()->what;
  EXPECT_GE(bench.checked.counters().too_soon, 1U);
  EXPECT_GE(bench.checked.counters().given, 25U);
}

TEST(CheckedCamera, a_pause_in_the_asking_is_not_silence_of_the_camera) {
  Bench bench(200);
  bench.run(0ms, 20 * period);
  bench.run(150 * period, 180 * period);
  EXPECT_FALSE(bench.checked.error()) << bench.checked.error()->what;
}

// Longer or shorter than any of the limits: what waits for us is not late, and our own pause is not silence.
TEST(CheckedCamera, no_pause_in_the_asking_is_the_cameras_fault) {
  for (Duration pause = 5ms; pause < 200ms; pause += 1ms) {
    Bench bench(60);
    bench.run(-1ms, 20 * period);
    // What was exposed as the asking ended waits, and nothing comes before it goes on: nobody wanted it.
    auto& script = bench.camera.script;
    while (script.size() > 1 && script[1].at < at(20 * period + pause)) script.erase(script.begin() + 1);
    const int given = bench.run(20 * period + pause, 55 * period);
    EXPECT_FALSE(bench.checked.error()) << bench.checked.error()->what << ", after " << seconds(pause);
    EXPECT_GE(given, 20) << seconds(pause);
  }
}

TEST(CheckedCamera, a_camera_that_is_always_a_little_late_is_found_out) {
  for (Duration late = 0ms; late < 12ms; late += 1ms) {
    Bench bench(60);
    for (auto& delivery : bench.camera.script) delivery.at = delivery.frame.stamp + 61ms + late;
    bench.run(-1ms, 60 * period);
    EXPECT_TRUE(bench.checked.error()) << seconds(late);
    EXPECT_EQ(bench.checked.counters().given, 0U) << seconds(late);
  }
}

TEST(CheckedCamera, passes_on_the_cameras_own_error) {
  Bench bench(1);
  bench.camera.own_error = DeviceError{DeviceErrorKind::disconnected, "camera", "gone", at(0ms)};
  ASSERT_TRUE(bench.checked.error());
  EXPECT_EQ(bench.checked.error()->kind, DeviceErrorKind::disconnected);
}

TEST(CheckedCamera, goes_on_after_rearm) {
  Bench bench(60);
  bench.camera.script[10].frame.bgr = noisy(1, 1.0);
  bench.run(0ms, 20 * period);
  ASSERT_TRUE(bench.checked.error());
  bench.checked.rearm();
  EXPECT_GE(bench.run(20 * period, 40 * period), 18);
  EXPECT_FALSE(bench.checked.error());
}

}  // namespace
}  // namespace hogline::hw
