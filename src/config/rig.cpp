#include "src/config/rig.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "src/config/config_error.hpp"
#include "src/config/schema.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

double radians(const json& degrees) { return degrees.get<double>() * std::numbers::pi / 180.0; }

vision::Mount read_mount(const json& m) {
  return {.x_m = m.at("x_m"),
          .y_m = m.at("y_m"),
          .z_m = m.at("z_m"),
          .roll_rad = radians(m.at("roll_deg")),
          .pitch_rad = radians(m.at("pitch_deg")),
          .yaw_rad = radians(m.at("yaw_deg"))};
}

vision::Intrinsics read_intrinsics(const json& c, const std::string& key, const Document& document) {
  vision::Intrinsics i;
  i.width_px = c.at("width_px");
  i.height_px = c.at("height_px");
  i.model = c.at("model") == "brown_conrady" ? vision::LensModel::brown_conrady : vision::LensModel::kannala_brandt;
  i.fx_px = c.at("fx_px");
  i.fy_px = c.at("fy_px");
  i.cx_px = c.at("cx_px");
  i.cy_px = c.at("cy_px");
  const json& distortion = c.at("distortion");
  const std::size_t wanted = i.model == vision::LensModel::brown_conrady ? 5 : 4;
  if (distortion.size() != wanted) {
    throw ConfigError(
        document.file, document.line_of(key + ".distortion"), key + ".distortion", distortion.dump(),
        fmt::format("must be a list of {} values with model {}", wanted, c.at("model").get<std::string>()));
  }
  for (std::size_t k = 0; k < wanted; ++k) i.distortion[k] = distortion[k];
  return i;
}

vision::SidelineKind read_sideline(const std::string& word) {
  if (word == "line") return vision::SidelineKind::line;
  if (word == "bumper") return vision::SidelineKind::bumper;
  if (word == "none") return vision::SidelineKind::none;
  return vision::SidelineKind::unknown;
}

std::optional<vision::CameraSetup> read_camera(const json& rig, const std::string& name, const Document& document) {
  if (!rig.at("cameras").contains(name)) return std::nullopt;
  const json& c = rig.at("cameras").at(name);
  vision::CameraSetup setup;
  setup.intrinsics = read_intrinsics(c, "cameras." + name, document);
  setup.mount = read_mount(c.at("mount"));
  setup.gamma = c.at("gamma");
  setup.sheet = {.width_m = rig.at("sheet").at("width_m"),
                 .sideline = read_sideline(rig.at("sheet").at("sideline").get<std::string>())};
  setup.ice = {.paint_depth_m = rig.at("ice").at("paint_depth_m"),
               .refractive_index = rig.at("ice").at("refractive_index")};
  setup.paint_depth_sigma_m = rig.at("ice").value("paint_depth_sigma_m", 0.0);
  return setup;
}

}  // namespace

const vision::CameraSetup& Rig::camera(std::string_view name) const {
  const auto& setup = name == "near" ? near_camera : name == "low" ? low_camera : far_camera;
  if (!setup) {
    throw ConfigError(file, 0, fmt::format("cameras.{}", name), "", "missing; this command needs that camera");
  }
  return *setup;
}

CameraSource Rig::source(std::string_view name) const {
  const auto found = sources.find(name);
  return found == sources.end() ? CameraSource{} : found->second;
}

namespace {

constexpr double usual_second_hue_deg = 47.0;
constexpr double least_hue_distance_deg = 30.0;  // nearer hues are not told apart in shade

double hue_distance_deg(const std::array<TeamColour, 2>& teams) {
  return std::abs(std::remainder(teams[0].hue_rad - teams[1].hue_rad, 2.0 * std::numbers::pi)) * 180.0 /
         std::numbers::pi;
}

void check_teams(const std::array<TeamColour, 2>& teams, const Document& document) {
  const auto refuse = [&](const std::string& value, const std::string& allowed) {
    throw ConfigError(document.file, document.line_of("stone.teams"), "stone.teams", value, allowed);
  };
  if (teams[0].name == teams[1].name) refuse(teams[0].name, "must be two different names");
  for (const TeamColour& t : teams) {
    if (t.name == "unknown") refuse(t.name, "must not be what a team is called that can not be told");
  }
  if (hue_distance_deg(teams) < least_hue_distance_deg) {
    refuse(teams[0].name + ", " + teams[1].name, "must be hues at least 30 degrees apart");
  }
}

StoneHandle read_stone(const json& section, const Document& document) {
  StoneHandle stone;
  stone.radius_m = section.at("handle_radius_m");
  stone.height_m = section.at("handle_height_m");
  stone.rim_rounding_m = section.value("handle_rim_rounding_m", 0.0);
  stone.teams = {{{"red", 0.0}, {"yellow", usual_second_hue_deg * std::numbers::pi / 180.0}}};
  if (section.contains("teams")) {
    for (std::size_t i = 0; i < stone.teams.size(); ++i) {
      const Section team(section.at("teams").at(i));
      stone.teams[i] = {team.word("name"), team.radians("hue_deg")};
    }
    check_teams(stone.teams, document);
  }
  return stone;
}

}  // namespace

namespace {

std::optional<hw::UdpCanConfig> read_can_udp(const json& rig, const Document& document) {
  if (!rig.contains("can")) return std::nullopt;
  const json& can = rig.at("can");
  if (can.contains("interface") == can.contains("udp_multicast")) {
    throw ConfigError(document.file, document.line_of("can"), "can", "",
                      "must hold exactly one of interface, udp_multicast");
  }
  if (!can.contains("udp_multicast")) return std::nullopt;
  const Section s(can.at("udp_multicast"));
  hw::UdpCanConfig udp{.group = s.word("group"),
                       .port = static_cast<std::uint16_t>(s.integer("port")),
                       .interface = s.word("interface")};
  if (const auto problem = config_error(udp)) {
    const char* key = "can.udp_multicast";
    throw ConfigError(document.file, document.line_of(key), key, "", *problem);
  }
  return udp;
}

}  // namespace

Rig load_rig(const std::string& path) { return parse_rig(read_file(path), path); }

Rig parse_rig(std::string_view text, const std::string& name) {
  Document document{.file = name, .lines = {}};
  const json rig = read_yaml(text, document);
  check(rig, "rig.schema.json", document);
  std::map<std::string, CameraSource, std::less<>> sources;
  for (const auto& [camera, section] : rig.at("cameras").items()) {
    if (section.contains("source")) sources.emplace(camera, read_camera_source(camera, section, document));
  }
  return {.file = name,
          .near_camera = read_camera(rig, "near", document),
          .low_camera = read_camera(rig, "low", document),
          .far_camera = read_camera(rig, "far", document),
          .sources = std::move(sources),
          .can_interface = rig.contains("can") ? rig.at("can").value("interface", std::string()) : std::string(),
          .can_udp = read_can_udp(rig, document),
          .stone = read_stone(rig.at("stone"), document)};
}

}  // namespace hogline::config
