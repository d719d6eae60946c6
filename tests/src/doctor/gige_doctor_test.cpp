// The doctor on steel's path to a GigE camera: Aravis' fake one, by the rig's own section.
#include <gtest/gtest.h>

#include "src/config/embedded.hpp"
#include "src/doctor/camera_check.hpp"
#include "src/doctor/report.hpp"
#include "src/doctor/steel_site.hpp"
#include "tests/hw/aravis/fake_gige_camera.hpp"

namespace hogline::doctor {
namespace {

config::DeviceRig rig_of(const std::string& serial) {
  std::string text{config::embedded_file("rigs/practice.yaml")};
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const auto at = text.rfind(from);  // the low camera's
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("width_px: 1600", "width_px: 512");
  replace("height_px: 1200", "height_px: 512");
  replace("source: {simulated: {}, max_age_s: 0.1, silence_limit_s: 0.15}",
          "source: {aravis: {serial: " + serial +
              ", pixel_format: Mono8, exposure_s: 0.003, frame_rate_hz: 60, packet_size_bytes: 9000,"
              " stamp: arrival, latency_s: 0, first_frame_s: 3, retry_s: 1}, max_age_s: 1, silence_limit_s: 2}");
  replace("interface: can0", "interface: nosuchcan0");
  return config::parse_device_rig(text, "rig.yaml");
}

Finding low_camera(const config::DeviceRig& rig) {
  SteelSite site(rig);
  return examine_camera("low", rig.rig.source("low"), false, site);
}

TEST(GigeDoctor, says_which_camera_it_is_and_how_it_delivers) {
  hw::FakeGigeCamera peer("CURL8");
  const Finding finding = low_camera(rig_of("CURL8"));
  EXPECT_NE(finding.verdict(), Verdict::wrong) << table({finding});
  EXPECT_EQ(finding.line, "aravis CURL8");
  EXPECT_NE(finding.found.find("Aravis Fake CURL8 firmware"), std::string::npos) << finding.found;
  EXPECT_NE(finding.found.find("pictures/s"), std::string::npos) << finding.found;
}

TEST(GigeDoctor, names_the_cameras_that_are_there_when_ours_is_not) {
  hw::FakeGigeCamera peer("CURL9");
  const Finding finding = low_camera(rig_of("MISSING"));
  EXPECT_EQ(finding.verdict(), Verdict::wrong);
  const std::string text = table({finding});
  EXPECT_NE(text.find("MISSING"), std::string::npos) << text;
  EXPECT_NE(text.find("CURL9"), std::string::npos) << text;
}

}  // namespace
}  // namespace hogline::doctor
