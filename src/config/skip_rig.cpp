#include "src/config/skip_rig.hpp"

#include <fmt/format.h>

#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

std::array<double, 3> read_point(const Section& s) { return {s.number("x_m"), s.number("y_m"), s.number("z_m")}; }

/// The camera on the head, from its mount at pan = tilt = 0.
servo::HeadGeometry geometry_of(const Section& head, const vision::Mount& mount) {
  servo::HeadGeometry g;
  g.pan_axis_m = read_point(head.section("pan_axis"));
  g.tilt_axis_m = read_point(head.section("tilt_axis"));
  const vision::Pose bMc = vision::bMc(mount);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    g.camera_m[k] = bMc.translation()(i) - g.pan_axis_m[k] - g.tilt_axis_m[k];
    for (int j = 0; j < 3; ++j) g.hRc[static_cast<std::size_t>(3 * i + j)] = bMc.linear()(i, j);
  }
  return g;
}

servo::HeadAxisLimits limits_of(const hw::HeadAxisConfig& axis) {
  return {.min_rad = axis.min_rad,
          .max_rad = axis.max_rad,
          .max_speed_radps = axis.max_speed_radps,
          .max_acceleration_radps2 = axis.acceleration_radps2};
}

servo::HeadAimingConfig read_aiming(const Section& head, const vision::Mount& far, const hw::TwoAxisHeadConfig& axes) {
  servo::HeadAimingConfig a;
  a.head = geometry_of(head, far);
  a.pan = limits_of(axes.pan);
  a.tilt = limits_of(axes.tilt);
  a.gains = {.at_zero_per_s = head.number("gain_at_zero_per_s"),
             .at_infinity_per_s = head.number("gain_at_infinity_per_s"),
             .slope_per_s = head.number("gain_slope_per_s")};
  a.limit_margin_rad = head.radians("limit_margin_deg");
  a.drive_lag_s = head.number("drive_lag_s");
  return a;
}

servo::SkipConfig read_skip(const Section& s, const Rig& rig, const hw::TwoAxisHeadConfig& head) {
  servo::SkipConfig c;
  c.aiming = read_aiming(s.section("head"), rig.camera("far").mount, head);
  c.near_head = geometry_of(s.section("head"), rig.camera("near").mount);
  c.far_tilt_sigma_rad = s.section("views").radians("far_tilt_sigma_deg");
  c.near_tilt_sigma_rad = s.section("views").radians("near_tilt_sigma_deg");
  const Section look = s.section("look");
  c.look = {.pan_rad = look.radians("pan_deg"), .tilt_rad = look.radians("tilt_deg")};
  c.look_frames = look.integer("frames");
  c.settle = look.duration("settle_s");
  c.wait_at = {s.section("wait_at").number("x_m"), s.section("wait_at").number("y_m")};
  const Section ages = s.section("ages");
  c.ages = {.head = ages.duration("head_s"),
            .pose = ages.duration("pose_s"),
            .far = ages.duration("far_s"),
            .stone = ages.duration("stone_s")};
  const Section d = s.section("deadlines");
  c.deadlines = {.boot = d.duration("boot_s"),
                 .look = d.duration("look_s"),
                 .aim = d.duration("aim_s"),
                 .wait = d.duration("wait_s"),
                 .follow = d.duration("follow_s")};
  return c;
}

}  // namespace

SkipRig load_skip_rig(const std::string& path) { return parse_skip_rig(read_file(path), path); }

SkipRig parse_skip_rig(std::string_view text, const std::string& name) {
  SkipRig rig;
  rig.rig = parse_rig(text, name);
  Document document{.file = name, .lines = {}};
  const json root = read_yaml(text, document);
  for (const char* section : {"head", "skip"}) {
    if (root.contains(section)) continue;
    throw ConfigError(name, 0, section, "",
                      "missing; the skip needs this section (config/rigs/skip.yaml is a pattern)");
  }
  const DeviceRig devices = parse_device_rig(text, name);
  rig.head = devices.head.value();
  rig.head.duties = {};
  const Section s(root);
  rig.skip = read_skip(s.section("skip"), rig.rig, rig.head);
  rig.far_mount_sigma_rad = s.section("skip").section("views").radians("far_mount_sigma_deg");
  return rig;
}

}  // namespace hogline::config
