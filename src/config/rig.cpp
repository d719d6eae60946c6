#include "src/config/rig.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "src/config/config_error.hpp"
#include "src/config/schema.hpp"
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

Rig load_rig(const std::string& path) { return parse_rig(read_file(path), path); }

Rig parse_rig(std::string_view text, const std::string& name) {
  Document document{.file = name, .lines = {}};
  const json rig = read_yaml(text, document);
  check(rig, "rig.schema.json", document);
  std::map<std::string, CameraSource, std::less<>> sources;
  for (const auto& [camera, section] : rig.at("cameras").items()) {
    if (section.contains("source")) sources.emplace(camera, read_camera_source(camera, section, document));
  }
  return {
      .file = name,
      .near_camera = read_camera(rig, "near", document),
      .low_camera = read_camera(rig, "low", document),
      .far_camera = read_camera(rig, "far", document),
      .sources = std::move(sources),
      .can_interface = rig.contains("can") ? rig.at("can").at("interface").get<std::string>() : std::string(),
      .stone = {.radius_m = rig.at("stone").at("handle_radius_m"), .height_m = rig.at("stone").at("handle_height_m")}};
}

}  // namespace hogline::config
