// Pictures through shared memory: whole ones, the newest, and what a writer that is gone or another looks like.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <opencv2/core.hpp>
#include <thread>

#include "hw/shared_frames/frame_writer.hpp"
#include "hw/shared_frames/shared_camera.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr FrameRingShape shape{.width_px = 64, .height_px = 48, .channels = 3};
constexpr Stamp start{100s};

std::string segment() { return "hogline-test-" + std::to_string(getpid()); }

SharedCamera camera(std::uint32_t width_px = 64) {
  return SharedCamera({.name = "near camera",
                       .segment = segment(),
                       .width_px = width_px,
                       .height_px = 48,
                       .silence_limit = 150ms,
                       .first_limit = 1s});
}

Frame frame(std::uint64_t id, Stamp stamp) {
  const auto value = static_cast<double>(id % 251);
  return {.bgr = cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(value)), .stamp = stamp, .id = id};
}

// The reader must have found the segment before what it is to be given is written.
void find(SharedCamera& reader, FrameWriter& writer, Stamp now) {
  writer.beat(now);
  EXPECT_FALSE(reader.latest(now));
}

TEST(SharedFrames, gives_the_newest_frame_once_with_stamp_and_number) {
  FrameWriter writer(segment(), shape, 1);
  SharedCamera reader = camera();
  find(reader, writer, start);
  for (std::uint64_t id = 1; id <= 9; ++id) writer.write(frame(id, start + std::chrono::milliseconds(id)));
  const auto given = reader.latest(start + 10ms);
  ASSERT_TRUE(given);
  EXPECT_EQ(given->id, 9U);
  EXPECT_EQ(given->stamp, start + 9ms);
  EXPECT_EQ(given->bgr.at<cv::Vec3b>(47, 63), cv::Vec3b(9, 9, 9));
  EXPECT_FALSE(reader.latest(start + 11ms));
  writer.write(frame(10, start + 12ms));
  ASSERT_TRUE(reader.latest(start + 13ms));
  EXPECT_FALSE(reader.error());
}

TEST(SharedFrames, what_was_written_before_anybody_asked_is_old) {
  FrameWriter writer(segment(), shape, 1);
  writer.write(frame(1, start));
  SharedCamera reader = camera();
  find(reader, writer, start + 50ms);
  writer.write(frame(2, start + 60ms));
  const auto given = reader.latest(start + 70ms);
  ASSERT_TRUE(given);
  EXPECT_EQ(given->id, 2U);
}

TEST(SharedFrames, the_writer_knows_whether_anybody_asks) {
  FrameWriter writer(segment(), shape, 1);
  EXPECT_FALSE(writer.wanted(start, 200ms));
  SharedCamera reader = camera();
  find(reader, writer, start);
  EXPECT_TRUE(writer.wanted(start + 100ms, 200ms));
  EXPECT_FALSE(writer.wanted(start + 300ms, 200ms));
}

TEST(SharedFrames, a_writer_whose_beat_stops_is_an_error_that_stays_until_rearmed) {
  FrameWriter writer(segment(), shape, 1);
  SharedCamera reader = camera();
  find(reader, writer, start);
  EXPECT_FALSE(reader.latest(start + 140ms));
  EXPECT_FALSE(reader.error());
  EXPECT_FALSE(reader.latest(start + 160ms));
  ASSERT_TRUE(reader.error());
  EXPECT_EQ(reader.error()->kind, DeviceErrorKind::disconnected);
  EXPECT_THAT(reader.error()->what, HasSubstr("160 ms"));
  writer.beat(start + 200ms);
  writer.write(frame(1, start + 200ms));
  EXPECT_FALSE(reader.latest(start + 210ms)) << "frames that come again do not clear it";
  reader.rearm();
  EXPECT_FALSE(reader.error());
  find(reader, writer, start + 220ms);
  writer.write(frame(2, start + 230ms));
  EXPECT_TRUE(reader.latest(start + 240ms));
}

TEST(SharedFrames, another_start_of_the_writer_is_found_after_rearming) {
  auto first = std::make_unique<FrameWriter>(segment(), shape, 1);
  SharedCamera reader = camera();
  find(reader, *first, start);
  FrameWriter second(segment(), shape, 2);
  second.beat(start + 50ms);
  first.reset();
  EXPECT_FALSE(reader.latest(start + 60ms));
  ASSERT_TRUE(reader.error());
  EXPECT_THAT(reader.error()->what, HasSubstr("ended"));
  reader.rearm();
  find(reader, second, start + 70ms);
  second.write(frame(1, start + 80ms));
  EXPECT_TRUE(reader.latest(start + 90ms)) << "the first writer's end has not taken the second one's segment away";
}

TEST(SharedFrames, a_writer_that_changed_while_nobody_asked_is_no_error) {
  auto first = std::make_unique<FrameWriter>(segment(), shape, 1);
  SharedCamera reader = camera();
  find(reader, *first, start);
  first->write(frame(400, start));
  const auto given = reader.latest(start + 1ms);
  ASSERT_TRUE(given);
  first.reset();
  FrameWriter second(segment(), shape, 2);
  find(reader, second, start + 60s);
  second.write(frame(1, start + 60010ms));
  const auto later = reader.latest(start + 60020ms);
  ASSERT_TRUE(later);
  EXPECT_GT(later->id, given->id) << "the second writer's numbers begin anew";
  EXPECT_FALSE(reader.error());
}

TEST(SharedFrames, a_segment_that_never_comes_or_that_nobody_writes_is_an_error_after_its_limit) {
  SharedCamera reader = camera();
  EXPECT_FALSE(reader.latest(start));
  EXPECT_FALSE(reader.error());
  for (Duration t = 0ms; t <= 1100ms; t += 100ms) EXPECT_FALSE(reader.latest(start + t));
  ASSERT_TRUE(reader.error());
  EXPECT_THAT(reader.error()->what, HasSubstr("No such file"));

  FrameWriter writer(segment(), shape, 1);
  writer.beat(start);
  SharedCamera late = camera();
  for (Duration t = 10s; t <= 12s; t += 100ms) EXPECT_FALSE(late.latest(start + t));
  ASSERT_TRUE(late.error());
  EXPECT_THAT(late.error()->what, HasSubstr("nobody writes"));
}

TEST(SharedFrames, pictures_of_another_size_are_refused) {
  FrameWriter writer(segment(), shape, 1);
  writer.beat(start);
  SharedCamera reader = camera(65);
  EXPECT_FALSE(reader.latest(start));
  ASSERT_TRUE(reader.error());
  EXPECT_EQ(reader.error()->kind, DeviceErrorKind::protocol);
  EXPECT_THAT(reader.error()->what, HasSubstr("64 x 48"));
}

TEST(SharedFrames, foreign_memory_is_believed_only_as_far_as_it_reaches) {
  struct Case {
    const char* what;
    std::function<void(FrameRingHeader&)> change;
  };
  for (const Case& c : {Case{"no magic", [](FrameRingHeader& h) { h.magic = 0; }},
                        {"larger than its segment", [](FrameRingHeader& h) { h.shape.width_px = 640; }},
                        {"no size", [](FrameRingHeader& h) { h.shape.height_px = 0; }},
                        {"two channels", [](FrameRingHeader& h) { h.shape.channels = 2; }},
                        {"other slots", [](FrameRingHeader& h) { h.slots = 5; }},
                        {"slots elsewhere", [](FrameRingHeader& h) { h.slot_bytes += 64; }}}) {
    FrameWriter writer(segment(), shape, 1);
    std::string problem;
    auto mapping = FrameRingMapping::open(segment(), problem);
    ASSERT_TRUE(mapping);
    c.change(mapping->header());
    EXPECT_FALSE(FrameRingMapping::open(segment(), problem)) << c.what;
    mapping->header().magic = FrameRingHeader::expected_magic;
    mapping->header().shape = shape;
  }
  const int file = shm_open(("/" + segment()).c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  std::string problem;
  EXPECT_FALSE(FrameRingMapping::open(segment(), problem)) << "an empty one";
  close(file);
  shm_unlink(("/" + segment()).c_str());
}

// Each picture is of one brightness: a torn one would show two.
TEST(SharedFrames, no_picture_is_torn) {
  FrameWriter writer(segment(), shape, 1);
  SharedCamera reader = camera();
  const Stamp begin = std::chrono::steady_clock::now();
  find(reader, writer, begin);
  std::atomic<bool> done = false;
  std::thread writing([&] {
    for (std::uint64_t id = 1; id <= 20000; ++id) writer.write(frame(id, begin + std::chrono::microseconds(id)));
    done = true;
  });
  std::uint64_t last = 0;
  int torn = 0;
  int given = 0;
  while (!done || given == 0) {
    writer.beat(begin);
    const auto got = reader.latest(begin);
    if (!got) continue;
    ++given;
    EXPECT_GT(got->id, last);
    last = got->id;
    const auto value = static_cast<double>(got->id % 251);
    if (cv::norm(got->bgr, cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(value)), cv::NORM_INF) != 0.0) ++torn;
  }
  writing.join();
  EXPECT_EQ(torn, 0);
  EXPECT_GT(given, 0);
}

}  // namespace
}  // namespace hogline::hw
