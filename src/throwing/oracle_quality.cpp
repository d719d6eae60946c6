#include "src/throwing/oracle_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <sstream>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/schema.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline {
namespace {

using nlohmann::json;

constexpr double deg = std::numbers::pi / 180.0;

SightError read_error(const json& o, double unit) {
  return {.offset = unit * o["offset"].get<double>(),
          .bias = unit * o["bias"].get<double>(),
          .drift = unit * o["drift"].get<double>(),
          .noise = unit * o["noise"].get<double>(),
          .claimed = unit * o["claimed"].get<double>()};
}

SightQuality read_camera(const config::Section& s) {
  SightQuality quality{
      .drift_time_s = s.number("drift_time_s"), .missing_frames = s.number("missing_frames"), .knots = {}};
  for (const json& k : s.raw("knots")) {
    quality.knots.push_back({.hog_m = k["hog_m"],
                             .missing_share = k["missing_share"],
                             .x = read_error(k["x_m"], 1.0),
                             .y = read_error(k["y_m"], 1.0),
                             .yaw = read_error(k["yaw_deg"], deg)});
  }
  return quality;
}

void write_error(std::string& text, const char* key, const SightError& e, double unit) {
  fmt::format_to(std::back_inserter(text),
                 "      {}: {{offset: {:.3g}, bias: {:.3g}, drift: {:.3g}, noise: {:.3g}, claimed: {:.3g}}}\n", key,
                 e.offset / unit, e.bias / unit, e.drift / unit, e.noise / unit, e.claimed / unit);
}

void write_camera(std::string& text, const char* name, const SightQuality& q) {
  fmt::format_to(std::back_inserter(text), "\n{}:\n  drift_time_s: {:.3g}\n  missing_frames: {:.3g}\n  knots:\n", name,
                 q.drift_time_s, q.missing_frames);
  for (const SightKnot& k : q.knots) {
    fmt::format_to(std::back_inserter(text), "    - hog_m: {:.3g}\n      missing_share: {:.3g}\n", k.hog_m,
                   k.missing_share);
    write_error(text, "x_m", k.x, 1.0);
    write_error(text, "y_m", k.y, 1.0);
    write_error(text, "yaw_deg", k.yaw, deg);
  }
}

}  // namespace

OracleQuality parse_oracle(std::string_view text, const std::string& name) {
  config::Document document{.file = name, .lines = {}};
  const json root = config::read_yaml(text, document);
  config::check(root, "oracle.schema.json", document);
  const config::Section s(root);
  const OracleQuality quality{.near = read_camera(s.section("near")), .low = read_camera(s.section("low"))};
  for (const auto& [key, camera] : {std::pair("near.knots", &quality.near), std::pair("low.knots", &quality.low)}) {
    const auto not_growing = [](const SightKnot& a, const SightKnot& b) { return a.hog_m >= b.hog_m; };
    if (std::ranges::adjacent_find(camera->knots, not_growing) != camera->knots.end()) {
      throw config::ConfigError(name, document.line_of(key), key, "", "hog_m must grow from knot to knot");
    }
  }
  return quality;
}

std::string oracle_text(const OracleQuality& quality, const std::string& about) {
  std::string text;
  std::istringstream lines(about);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  write_camera(text, "near", quality.near);
  write_camera(text, "low", quality.low);
  return text;
}

OracleQuality measured_quality() {
  return parse_oracle(config::embedded_file("oracles/measured.yaml"), "measured oracle");
}

}  // namespace hogline
