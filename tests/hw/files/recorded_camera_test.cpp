// Recordings play on a stepped clock: the same calls give the same frames, with numbers, gaps and stamps.
#include "hw/files/recorded_camera.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace hogline::hw::files {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const cv::Size size(64, 48);
constexpr Stamp start{100s};

cv::Mat picture(int level, cv::Size of = size) { return {of, CV_8UC3, cv::Scalar::all(level)}; }

class Recordings : public testing::Test {
 protected:
  Recordings()
      : folder_(fs::temp_directory_path() / ("hogline-recording-" + std::to_string(getpid()) + "-" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Recordings() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void save(const std::string& name, int level, cv::Size of = size) const {
    ASSERT_TRUE(cv::imwrite(path(name), picture(level, of)));
  }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name)) << content;
    return path(name);
  }
  std::string video(int frames, double rate_hz, cv::Size of = size) const {
    cv::VideoWriter writer(path("run.avi"), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz, of);
    EXPECT_TRUE(writer.isOpened());
    for (int k = 0; k < frames; ++k) writer.write(picture(10 + 10 * k, of));
    writer.release();
    return path("run.avi");
  }

  fs::path folder_;
};

int level_of(const Frame& frame) { return frame.bgr.at<cv::Vec3b>(10, 10)[1]; }

TEST_F(Recordings, a_folder_plays_in_the_order_of_its_numbers) {
  save("run-10.png", 100);
  save("run-2.png", 20);
  save("run-001.PNG", 10);
  write("notes.txt", "not a picture");
  FolderCamera camera("low camera", read_folder(folder_.string(), 50.0), size, start);
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(camera.next_stamp(), start + k * Duration(20ms));
    const auto frame = camera.latest(*camera.next_stamp());
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, static_cast<std::uint64_t>(k));
    EXPECT_EQ(level_of(*frame), (std::array{10, 20, 100})[static_cast<std::size_t>(k)]);
  }
  EXPECT_FALSE(camera.next_stamp());
  EXPECT_FALSE(camera.latest(start + 1h));
  EXPECT_FALSE(camera.error());
}

TEST_F(Recordings, a_slow_reader_gets_the_newest_and_nothing_twice) {
  for (int k = 0; k < 10; ++k) save(std::to_string(k) + ".png", 10 + 10 * k);
  FolderCamera camera("low camera", read_folder(folder_.string(), 50.0), size, start);
  EXPECT_FALSE(camera.latest(start - 1ms));
  const auto frame = camera.latest(start + 105ms);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->id, 5U);
  EXPECT_EQ(frame->stamp, start + 100ms);
  EXPECT_FALSE(camera.latest(start + 119ms));
  EXPECT_EQ(camera.latest(start + 1h)->id, 9U);
}

TEST_F(Recordings, a_stamps_file_gives_numbers_gaps_and_times) {
  save("a.png", 10);
  save("b.png", 20);
  const Recording recording = read_stamps_file(write("stamps.csv", "name,id,time_s\nb.png,7,0.5\na.png,12,0.75\r\n"));
  ASSERT_EQ(recording.problem, "");
  FolderCamera camera("low camera", recording, size, start);
  const auto first = camera.latest(start + 500ms);
  const auto second = camera.latest(start + 750ms);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(level_of(*first), 20);
  EXPECT_EQ(first->id, 7U);
  EXPECT_EQ(second->id, 12U);
  EXPECT_EQ(second->stamp, start + 750ms);
}

TEST_F(Recordings, a_stamps_file_with_a_mistake_is_refused_with_its_line) {
  for (const char* lines : {"a.png,1", "a.png,1,x", "a.png,-1,0.5", "a.png,1,nan", "a.png,1,1e300", ",1,0.5",
                            "a.png,1,-0.5", "a.png,5,0.5\nb.png,5,0.6", "a.png,5,0.5\nb.png,6,0.5"}) {
    const std::string path = write("stamps.csv", std::string("name,id,time_s\n") + lines + "\n");
    const Recording recording = read_stamps_file(path);
    EXPECT_NE(recording.problem.find("stamps.csv:"), std::string::npos) << lines;
  }
  EXPECT_NE(read_stamps_file(write("stamps.csv", "a.png,1,0.5\n")).problem, "") << "no first line";
  EXPECT_NE(read_stamps_file(write("stamps.csv", "name,id,time_s\n")).problem, "") << "empty";
  EXPECT_NE(read_stamps_file(path("none.csv")).problem, "");
  EXPECT_NE(read_folder(path("none"), 60.0).problem, "");
  EXPECT_NE(read_folder(folder_.string(), 60.0).problem, "") << "no picture in it";
}

TEST_F(Recordings, a_picture_of_another_size_or_damaged_is_an_error_and_is_passed_over) {
  save("0.png", 10);
  save("1.png", 20, {32, 24});
  save("2.png", 30);
  FolderCamera camera("low camera", read_folder(folder_.string(), 50.0), size, start);
  EXPECT_TRUE(camera.latest(start));
  EXPECT_FALSE(camera.error());
  EXPECT_FALSE(camera.latest(start + 20ms));
  ASSERT_TRUE(camera.error());
  EXPECT_EQ(camera.error()->device, "low camera");
  EXPECT_NE(camera.error()->what.find("32x24"), std::string::npos) << camera.error()->what;
  EXPECT_TRUE(camera.latest(start + 40ms));
  EXPECT_TRUE(camera.error()) << "latched";
  camera.rearm();
  EXPECT_FALSE(camera.error());
}

TEST_F(Recordings, a_video_plays_frame_by_frame) {
  VideoCamera camera("low camera", video(20, 25.0), 0.0, size, start);
  ASSERT_FALSE(camera.error()) << camera.error()->what;
  for (int k = 0; k < 20; ++k) {
    ASSERT_EQ(camera.next_stamp(), start + k * Duration(40ms));
    const auto frame = camera.latest(*camera.next_stamp());
    ASSERT_TRUE(frame) << k;
    EXPECT_EQ(frame->id, static_cast<std::uint64_t>(k));
    EXPECT_NEAR(level_of(*frame), 10 + 10 * k, 3) << "JPEG";
  }
  EXPECT_FALSE(camera.next_stamp());
}

TEST_F(Recordings, a_videos_newest_frame_is_kept_when_it_is_read_too_late) {
  VideoCamera camera("low camera", video(20, 25.0), 50.0, size, start);
  EXPECT_EQ(camera.latest(start + 105ms)->id, 5U) << "at the rate given, not the file's";
  const auto last = camera.latest(start + 1h);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->id, 19U);
  EXPECT_NEAR(level_of(*last), 200, 3);
}

TEST_F(Recordings, what_is_no_video_or_of_another_size_is_an_error) {
  EXPECT_TRUE(VideoCamera("c", path("none.avi"), 60.0, size, start).error());
  EXPECT_TRUE(VideoCamera("c", write("text.avi", "no video"), 60.0, size, start).error());
  VideoCamera camera("c", video(3, 25.0, {128, 96}), 0.0, size, start);
  EXPECT_FALSE(camera.latest(start));
  ASSERT_TRUE(camera.error());
  EXPECT_NE(camera.error()->what.find("128x96"), std::string::npos) << camera.error()->what;
}

}  // namespace
}  // namespace hogline::hw::files
