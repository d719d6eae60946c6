// The rig file: one robot, its cameras, and what is known of the sheet. The same schema for simulation and steel.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "hw/udp_can/udp_can_config.hpp"
#include "src/config/camera_source.hpp"
#include "vision/camera_setup.hpp"

namespace hogline::config {

/// What one team's handles look like.
struct TeamColour {
  std::string name;
  double hue_rad = 0.0;  ///< in white light, on the colour circle: red 0, green 2 pi / 3
};

/// The circular boundary of a stone's handle, and the two teams' colours.
struct StoneHandle {
  double radius_m = 0.0;
  double height_m = 0.0;
  double rim_rounding_m = 0.0;  ///< 0: sharp
  std::array<TeamColour, 2> teams;
};

struct Rig {
  std::string file;
  std::optional<vision::CameraSetup> near_camera;
  std::optional<vision::CameraSetup> low_camera;
  std::optional<vision::CameraSetup> far_camera;
  std::map<std::string, CameraSource, std::less<>> sources;  ///< by the camera's key; those that have one
  std::string can_interface;                                 ///< of the kernel; empty if the rig names none
  std::optional<hw::UdpCanConfig> can_udp;                   ///< the bus between programs, in its place
  StoneHandle stone;

  /// One of the cameras by its key: near, low or far. Throws ConfigError where the rig has none of that name.
  const vision::CameraSetup& camera(std::string_view name) const;
  /// Where its pictures come from; a rig that does not say so means the simulated rink.
  CameraSource source(std::string_view name) const;
};

/// Reads and checks a rig file. Throws ConfigError.
Rig load_rig(const std::string& path);

/// The same from text; `name` stands in messages.
Rig parse_rig(std::string_view text, const std::string& name);

}  // namespace hogline::config
