// The doctor on the machine's own lines: ports, files and recordings that can not be what the rig says.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>

#include "src/config/device_rig.hpp"
#include "src/config/embedded.hpp"
#include "src/doctor/examination.hpp"
#include "src/doctor/report.hpp"
#include "src/doctor/steel_site.hpp"

namespace hogline::doctor {
namespace {

namespace fs = std::filesystem;

// The practice rig's sections of these names, and its cameras.
std::string part(const std::vector<std::string>& sections) {
  std::istringstream lines{std::string(config::embedded_file("rigs/practice.yaml"))};
  std::string text;
  bool wanted = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && std::isalpha(static_cast<unsigned char>(line[0])) != 0) {
      const std::string name = line.substr(0, line.find(':'));
      wanted = name == "cameras" || name == "sheet" || name == "ice" || name == "stone" ||
               std::ranges::count(sections, name) > 0;
    }
    if (wanted) text += line + "\n";
  }
  return text;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class SteelDoctor : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // The low camera from this source, in the pictures' size.
  static std::string low_from(const std::string& source) {
    std::string text = part({});
    const auto low = text.find("\n  low:");
    text = text.substr(0, text.find("  near:")) + text.substr(low + 1);
    text = with(std::move(text), "width_px: 1600", "width_px: 320");
    text = with(std::move(text), "height_px: 1200", "height_px: 240");
    text = with(std::move(text), "cx_px: 795.7", "cx_px: 160");
    text = with(std::move(text), "cy_px: 604.1", "cy_px: 120");
    return with(std::move(text), "simulated: {}", source);
  }

  std::string video(const std::string& name, int frames) const {
    cv::VideoWriter writer(path(name), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 60.0, cv::Size(320, 240));
    for (int i = 0; i < frames; ++i) {
      cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(90, 100, 110));
      cv::circle(picture, {20 + 4 * i, 120}, 15, cv::Scalar(200, 180, 30), cv::FILLED);
      cv::rectangle(picture, {100, 20, 120, 60}, cv::Scalar(220, 220, 220), cv::FILLED);
      writer.write(picture);
    }
    return path(name);
  }

  static std::vector<Finding> examine(const std::string& text) {
    const config::DeviceRig rig = config::parse_device_rig(text, "rig.yaml");
    SteelSite site(rig);
    return doctor::examine(rig, site);
  }

  // Of this device something is wrong, in these words, and there is advice.
  static void expect_wrong(const std::string& text, const std::string& device, const std::vector<std::string>& words) {
    const auto findings = examine(text);
    const auto found = std::ranges::find(findings, device, &Finding::device);
    ASSERT_NE(found, findings.end()) << table(findings);
    EXPECT_EQ(found->verdict(), Verdict::wrong) << table(findings);
    for (const std::string& word : words) EXPECT_NE(table({*found}).find(word), std::string::npos) << table(findings);
    for (const Remark& remark : found->remarks) EXPECT_FALSE(remark.advice.empty()) << remark.what;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("steel_doctor_" + std::to_string(getpid()));
};

TEST_F(SteelDoctor, a_serial_port_that_is_none_is_named_for_what_it_is) {
  std::ofstream(path("file")) << "no port";
  const std::string gyro = part({"gyro"});
  const std::string device = "/dev/serial/by-id/usb-GYRO";
  expect_wrong(with(gyro, device, path("nowhere")), "gyro", {path("nowhere"), "No such file", "plug the adapter in"});
  expect_wrong(with(gyro, device, path("file")), "gyro", {"is no serial port", "ls /dev/serial/by-id"});
  expect_wrong(with(gyro, device, folder_.string()), "gyro", {"is a folder"});

  std::string modbus = with(part({"modbus", "gripper", "arm"}), "  tcp: {address: 127.0.0.1, port: 502}\n", "");
  modbus = with(std::move(modbus), "# rtu: {device: /dev/serial/by-id/usb-ADAPTER", "rtu: {device: " + path("file"));
  expect_wrong(modbus, "arm", {"is no serial port"});
}

TEST_F(SteelDoctor, nobody_at_the_grippers_port) {
  const std::string text = with(part({"modbus", "gripper"}), "port: 502", "port: 1");
  expect_wrong(text, "jaws", {"refused", "address and port"});
  EXPECT_EQ(examine(text).size(), 4U) << "jaws, belt, and two cameras: the rig has no arm";
}

TEST_F(SteelDoctor, a_recording_that_can_not_be_played_says_why) {
  std::ofstream(path("text.mp4")) << "this is no film\n";
  expect_wrong(low_from("folder: {path: " + folder_.string() + ", rate_hz: 60}"), "low camera",
               {"holds no JPEG or PNG file", "cameras.low.source"});
  expect_wrong(low_from("folder: {path: " + path("nowhere") + ", rate_hz: 60}"), "low camera",
               {"can not be read as a folder"});
  expect_wrong(low_from("video: {path: " + path("nowhere.mp4") + "}"), "low camera", {"no such file"});
  expect_wrong(low_from("video: {path: " + path("text.mp4") + "}"), "low camera", {"can not be played"});
}

TEST_F(SteelDoctor, a_video_without_its_end_is_told_from_a_whole_one) {
  const std::string whole = video("whole.avi", 60);
  const auto findings = examine(low_from("video: {path: " + whole + "}"));
  EXPECT_TRUE(all_well(findings)) << table(findings);

  const std::string cut = video("cut.avi", 60);
  fs::resize_file(cut, fs::file_size(cut) * 6 / 10);
  expect_wrong(low_from("video: {path: " + cut + "}"), "low camera", {"cut short", "of 60 frames", "copy it whole"});
}

TEST_F(SteelDoctor, a_bus_without_declared_nodes_is_examined_for_itself) {
  const auto findings = examine(with(part({"can"}), "can0", "nosuchcan0"));
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].device, "CAN bus");
  EXPECT_EQ(findings[0].verdict(), Verdict::wrong);
}

}  // namespace
}  // namespace hogline::doctor
