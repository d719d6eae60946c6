// The source section of a camera: read in SI units, or refused with the key that is wrong.
#include "src/config/camera_source.hpp"

#include <gtest/gtest.h>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/rig.hpp"

namespace hogline::config {
namespace {

using namespace std::chrono_literals;

const std::string aravis =
    "aravis: {serial: \"0815\", pixel_format: BayerRG8, exposure_s: 0.003, frame_rate_hz: 60, stamp: exposure_end,"
    " latency_s: 0.004, first_frame_s: 2, retry_s: 1}";

// The practice rig with another source for the low camera.
Rig rig_with(const std::string& source) {
  std::string text{embedded_file("rigs/practice.yaml")};
  const std::string from = "source: {simulated: {},";
  text.replace(text.find(from), from.size(), "source: {" + source + (source.empty() ? "" : ","));
  return parse_rig(text, "rig.yaml");
}

TEST(CameraSource, of_a_genicam_camera_is_read_with_the_cameras_size) {
  const CameraSource source = rig_with(aravis).source("low");
  const auto& a = std::get<hw::AravisConfig>(source.device);
  EXPECT_EQ(a.name, "low camera");
  EXPECT_EQ(a.serial, "0815");
  EXPECT_EQ(a.address, "");
  EXPECT_EQ(a.width_px, 1600);
  EXPECT_EQ(a.height_px, 1200);
  EXPECT_FALSE(a.offset_x_px || a.gain_db);
  EXPECT_EQ(a.packet_size_bytes, 0);
  EXPECT_EQ(a.stamp, hw::CameraStampMeaning::exposure_end);
  EXPECT_EQ(a.latency, 4ms);
  EXPECT_EQ(a.first_frame_limit, 2s);
  EXPECT_EQ(a.silence_limit, 150ms) << "the source's";
  EXPECT_EQ(source.max_age, 100ms);
}

TEST(CameraSource, of_recordings_is_read) {
  const auto folder = std::get<FolderSource>(rig_with("folder: {path: run, rate_hz: 60}").source("low").device);
  EXPECT_EQ(folder.path, "run");
  EXPECT_DOUBLE_EQ(folder.rate_hz, 60.0);
  EXPECT_EQ(std::get<FolderSource>(rig_with("folder: {stamps: a.csv}").source("low").device).stamps, "a.csv");
  EXPECT_DOUBLE_EQ(std::get<VideoSource>(rig_with("video: {path: a.mp4}").source("low").device).rate_hz, 0.0);
}

TEST(CameraSource, in_shared_memory_is_read) {
  const CameraSource source = rig_with("shared_memory: low-1").source("low");
  EXPECT_EQ(std::get<SharedMemorySource>(source.device).segment, "low-1");
  EXPECT_THROW(rig_with("shared_memory: a/b"), ConfigError);
  EXPECT_THROW(rig_with("shared_memory: low, simulated: {}"), ConfigError);
}

TEST(CanSection, names_the_kernels_bus_or_the_one_between_programs) {
  const auto with_can = [](const std::string& can) {
    std::string text{embedded_file("rigs/practice.yaml")};
    const std::string from = "can: {interface: can0}";
    return parse_rig(text.replace(text.find(from), from.size(), "can: {" + can + "}"), "rig.yaml");
  };
  const std::string udp = "udp_multicast: {group: 239.74.163.2, port: 43113, interface: lo}";
  const Rig rig = with_can(udp);
  EXPECT_EQ(rig.can_interface, "");
  ASSERT_TRUE(rig.can_udp);
  EXPECT_EQ(rig.can_udp->group, "239.74.163.2");
  EXPECT_EQ(rig.can_udp->port, 43113);
  EXPECT_EQ(rig.can_udp->interface, "lo");
  EXPECT_THROW(with_can(""), ConfigError);
  EXPECT_THROW(with_can("interface: can0, " + udp), ConfigError);
  EXPECT_THROW(with_can("udp_multicast: {group: 10.0.0.1, port: 43113, interface: lo}"), ConfigError);
}

TEST(CameraSource, left_out_is_the_simulated_rink) {
  const Rig rig = rig_with("simulated: {}");
  EXPECT_TRUE(std::holds_alternative<SimulatedSource>(rig.source("far").device));
  EXPECT_FALSE(rig.sources.contains("far"));
  EXPECT_TRUE(rig.sources.contains("near"));
  EXPECT_EQ(rig.can_interface, "can0");
}

struct Refusal {
  const char* description;
  std::string source;
  const char* key;  ///< under cameras.low.source
};

void PrintTo(const Refusal& r, std::ostream* out) { *out << r.description; }

class SourceRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(SourceRefusals, name_the_key) {
  try {
    rig_with(GetParam().source);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.key, std::string("cameras.low.source") + GetParam().key) << e.what();
  }
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = aravis;
  return text.replace(text.find(from), from.size(), to);
}

INSTANTIATE_TEST_SUITE_P(
    Table, SourceRefusals,
    testing::Values(Refusal{"none", "", ""}, Refusal{"two", "simulated: {}, video: {path: a.mp4}", ""},
                    Refusal{"unknown", "webcam: {}", ".webcam"},
                    Refusal{"a serial number without quotes", changed("\"0815\"", "815"), ".aravis.serial"},
                    Refusal{"a format nobody can use", changed("BayerRG8", "Mono16"), ".aravis.pixel_format"},
                    Refusal{"half a region", changed("retry_s: 1", "retry_s: 1, offset_x_px: 8"), ".aravis"},
                    Refusal{"an exposure longer than a frame", changed("0.003", "0.02"), ".aravis"},
                    Refusal{"no rate", changed("frame_rate_hz: 60, ", ""), ".aravis.frame_rate_hz"},
                    Refusal{"half a folder", "folder: {path: run}", ".folder"},
                    Refusal{"folder and stamps", "folder: {path: run, rate_hz: 60, stamps: a.csv}", ".folder"},
                    Refusal{"a video without a path", "video: {}", ".video.path"}));

}  // namespace
}  // namespace hogline::config
