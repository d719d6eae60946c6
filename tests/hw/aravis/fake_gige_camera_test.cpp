// The whole adapter against a foreign peer: Aravis' fake GigE Vision camera, over real sockets.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <thread>
#include <vector>

#include "hw/aravis/aravis_camera.hpp"
#include "tests/hw/aravis/fake_gige_camera.hpp"
#include "tests/hw/eventually.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

AravisConfig config_of(const std::string& serial) {
  AravisConfig c;
  c.name = "low camera";
  c.serial = serial;
  c.width_px = 512;
  c.height_px = 512;
  c.pixel_format = "Mono8";
  c.exposure_s = 0.003;
  c.frame_rate_hz = 60.0;
  c.packet_size_bytes = 9000;
  c.latency = Duration{};
  c.first_frame_limit = 3s;
  c.silence_limit = 1s;
  c.retry_delay = 200ms;
  return c;
}

struct Bench {
  explicit Bench(const AravisConfig& config) : camera(config, clock) {}

  // The next `count` frames, and when each was taken.
  std::vector<Frame> frames(std::size_t count) {
    std::vector<Frame> taken;
    comes_true([&] {
      if (auto frame = camera.latest(clock.now())) {
        ages_s.push_back(seconds(clock.now() - frame->stamp));
        taken.push_back(std::move(*frame));
      }
      return taken.size() >= count;
    });
    return taken;
  }
  double median_age_s() {
    std::nth_element(ages_s.begin(), ages_s.begin() + static_cast<std::ptrdiff_t>(ages_s.size() / 2), ages_s.end());
    return ages_s[ages_s.size() / 2];
  }

  SteadyClock clock;
  std::vector<double> ages_s;
  AravisCamera camera;
};

// What the fake paints, seen on its wire: a diagonal ramp, scaled by gain and exposure, that moves with the frame.
bool is_diagonal_ramp(const cv::Mat& mono) {
  int agree = 0;
  int compared = 0;
  for (int y = 1; y < mono.rows; y += 7) {
    for (int x = 0; x + 1 < mono.cols; x += 7) {
      ++compared;
      agree += mono.at<std::uint8_t>(y, x) == mono.at<std::uint8_t>(y - 1, x + 1) ? 1 : 0;
    }
  }
  return agree == compared;
}

void expect_growing(const std::vector<Frame>& frames) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].id, frames[i - 1].id);
    EXPECT_GT(frames[i].stamp, frames[i - 1].stamp);
  }
}

TEST(FakeGigeCamera, streams_whole_pictures_with_growing_numbers_and_stamps) {
  FakeGigeCamera peer("CURL1");
  Bench bench(config_of("CURL1"));
  const auto frames = bench.frames(60);
  ASSERT_EQ(frames.size(), 60U) << (bench.camera.error() ? bench.camera.error()->what : "no error");
  EXPECT_FALSE(bench.camera.error());
  expect_growing(frames);
  for (const Frame& frame : frames) {
    ASSERT_EQ(frame.bgr.size(), cv::Size(512, 512));
    ASSERT_EQ(frame.bgr.type(), CV_8UC1);
    EXPECT_TRUE(is_diagonal_ramp(frame.bgr));
  }
  EXPECT_GT(bench.median_age_s(), 0.0);
  EXPECT_LT(bench.median_age_s(), 0.1);

  const FeedState state = bench.camera.state();
  EXPECT_EQ(state.identity.serial, "CURL1");
  EXPECT_EQ(state.identity.vendor, "Aravis");
  EXPECT_EQ(state.identity.address, "127.0.0.1");
  EXPECT_EQ(state.phase, FeedPhase::streaming);
  RecordProperty("median_age_ms", std::to_string(1e3 * bench.median_age_s()));
}

TEST(FakeGigeCamera, sets_region_and_colour_and_uses_the_cameras_own_stamps) {
  FakeGigeCamera peer("CURL2");
  AravisConfig config = config_of("CURL2");
  config.width_px = 640;
  config.height_px = 480;
  config.offset_x_px = 0;
  config.offset_y_px = 0;
  config.pixel_format = "BayerRG8";
  config.stamp = CameraStampMeaning::exposure_start;
  Bench bench(config);
  const auto frames = bench.frames(40);
  ASSERT_EQ(frames.size(), 40U) << (bench.camera.error() ? bench.camera.error()->what : "no error");
  expect_growing(frames);
  EXPECT_EQ(frames.back().bgr.type(), CV_8UC3);
  EXPECT_EQ(frames.back().bgr.size(), cv::Size(640, 480));
  EXPECT_LT(bench.median_age_s(), 0.1);
}

TEST(FakeGigeCamera, another_size_than_the_rigs_is_refused_and_never_scaled) {
  FakeGigeCamera peer("CURL3");
  AravisConfig config = config_of("CURL3");
  config.width_px = 1600;
  config.height_px = 1200;
  Bench bench(config);
  ASSERT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_EQ(bench.camera.error()->kind, DeviceErrorKind::implausible) << bench.camera.error()->what;
  EXPECT_NE(bench.camera.error()->what.find("512x512"), std::string::npos) << bench.camera.error()->what;
  EXPECT_FALSE(bench.camera.latest(bench.clock.now()));
}

TEST(FakeGigeCamera, another_cameras_serial_number_is_not_taken_for_ours) {
  FakeGigeCamera peer("CURL4");
  Bench bench(config_of("OTHER"));
  ASSERT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_EQ(bench.camera.error()->kind, DeviceErrorKind::disconnected);
  EXPECT_NE(bench.camera.error()->what.find("CURL4"), std::string::npos) << bench.camera.error()->what;
}

TEST(FakeGigeCamera, a_pulled_plug_is_told_by_the_frames_age_and_the_stream_comes_back_by_itself) {
  FakeGigeCamera peer("CURL5");
  Bench bench(config_of("CURL5"));
  ASSERT_EQ(bench.frames(10).size(), 10U) << (bench.camera.error() ? bench.camera.error()->what : "no error");
  peer.kill();
  ASSERT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_EQ(bench.camera.error()->kind, DeviceErrorKind::timeout) << bench.camera.error()->what;

  peer.start();
  EXPECT_EQ(bench.frames(10).size(), 10U);
  EXPECT_TRUE(bench.camera.error()) << "latched until somebody looks at it";
  bench.camera.rearm();
  EXPECT_FALSE(bench.camera.error());
}

TEST(FakeGigeCamera, a_camera_that_stands_still_is_told_and_comes_back) {
  FakeGigeCamera peer("CURL6");
  Bench bench(config_of("CURL6"));
  ASSERT_EQ(bench.frames(10).size(), 10U) << (bench.camera.error() ? bench.camera.error()->what : "no error");
  peer.signal(SIGSTOP);
  ASSERT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_EQ(bench.camera.error()->kind, DeviceErrorKind::timeout) << bench.camera.error()->what;
  peer.signal(SIGCONT);
  EXPECT_EQ(bench.frames(10).size(), 10U);
}

TEST(FakeGigeCamera, lost_packets_cost_frames_and_no_frame_is_patched_up) {
  FakeGigeCamera peer("CURL7", {"-r", "10"});  // of a thousand; a frame has about thirty packets
  Bench bench(config_of("CURL7"));
  const auto frames = bench.frames(60);
  ASSERT_EQ(frames.size(), 60U) << (bench.camera.error() ? bench.camera.error()->what : "no error");
  for (const Frame& frame : frames) EXPECT_TRUE(is_diagonal_ramp(frame.bgr));
  const FeedCounters counters = bench.camera.state().counters;
  EXPECT_GT(counters.incomplete + counters.lost, 0U);
  expect_growing(frames);
}

}  // namespace
}  // namespace hogline::hw
