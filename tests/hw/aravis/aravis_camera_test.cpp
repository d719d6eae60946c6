// The threaded camera over a source that is not Aravis: latest frame, watchdog, end.
#include "hw/aravis/aravis_camera.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/hw/aravis/scripted_source.hpp"
#include "tests/hw/eventually.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

// Counts frames as fast as they are taken, and can stop or hang.
class EndlessSource final : public FrameSource {
 public:
  std::optional<SourceFault> start() override { return std::nullopt; }
  void stop() override {}
  std::optional<CameraBuffer> next(Duration wait) override {
    while (hangs) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(1ms);
    if ((wait == Duration{} && !always_more) || silent) return std::nullopt;
    bytes_.assign(static_cast<std::size_t>(test_width_px * test_height_px), static_cast<std::uint8_t>(++count));
    CameraBuffer buffer;
    buffer.complete = true;
    buffer.bytes = bytes_;
    buffer.width_px = test_width_px;
    buffer.height_px = test_height_px;
    buffer.pixel_format = test_mono8;
    buffer.frame_id = count;
    buffer.wall = std::chrono::system_clock::now().time_since_epoch();
    return buffer;
  }
  std::size_t waiting() const override { return always_more ? 1 : 0; }
  bool control_lost() const override { return false; }
  const CameraIdentity& identity() const override { return identity_; }

  std::atomic<bool> silent{false};
  std::atomic<bool> hangs{false};
  std::atomic<bool> always_more{false};  ///< frames come faster than they are taken
  std::uint64_t count = 0;

 private:
  CameraIdentity identity_;
  std::vector<std::uint8_t> bytes_;
};

struct Bench {
  static AravisConfig config() {
    AravisConfig c = test_config();
    c.silence_limit = 500ms;  // longer than a busy machine stalls
    return c;
  }
  SteadyClock clock;
  std::unique_ptr<EndlessSource> owned = std::make_unique<EndlessSource>();
  EndlessSource& source = *owned;
  AravisCamera camera{config(), clock, std::move(owned)};
};

TEST(AravisCamera, gives_newer_and_newer_frames_and_none_twice) {
  Bench bench;
  std::uint64_t last = 0;
  int given = 0;
  EXPECT_TRUE(comes_true([&] {
    if (const auto frame = bench.camera.latest(bench.clock.now())) {
      EXPECT_GT(frame->id, last);
      EXPECT_LE(frame->stamp, bench.clock.now());
      last = frame->id;
      ++given;
    }
    return given >= 50;
  }));
  EXPECT_FALSE(bench.camera.error());
}

TEST(AravisCamera, gives_frames_also_when_they_come_faster_than_they_are_taken) {
  Bench bench;
  bench.source.always_more = true;
  int given = 0;
  EXPECT_TRUE(comes_true([&] { return (given += bench.camera.latest(bench.clock.now()) ? 1 : 0) >= 10; }));
}

TEST(AravisCamera, tells_silence_and_keeps_it_until_rearmed) {
  Bench bench;
  ASSERT_TRUE(comes_true([&] { return bench.camera.latest(bench.clock.now()).has_value(); }));
  bench.source.silent = true;
  ASSERT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_EQ(bench.camera.error()->kind, DeviceErrorKind::timeout);
  bench.source.silent = false;
  ASSERT_TRUE(comes_true([&] { return bench.camera.state().counters.outages > 0; }));
  EXPECT_TRUE(bench.camera.error());
  bench.camera.rearm();
  EXPECT_TRUE(comes_true([&] { return !bench.camera.error() && bench.camera.latest(bench.clock.now()); }));
}

TEST(AravisCamera, tells_silence_also_when_the_library_does_not_return) {
  Bench bench;
  ASSERT_TRUE(comes_true([&] { return bench.camera.latest(bench.clock.now()).has_value(); }));
  bench.source.hangs = true;
  EXPECT_TRUE(comes_true([&] { return bench.camera.error().has_value(); }));
  EXPECT_TRUE(bench.camera.error() && bench.camera.error()->kind == DeviceErrorKind::timeout);
  bench.source.hangs = false;
}

}  // namespace
}  // namespace hogline::hw
