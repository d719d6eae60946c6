#include "src/percept_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace hogline {
namespace {

using nlohmann::ordered_json;

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

// Enough digits for any camera, few enough to read.
double rounded(double value, double step) { return std::round(value / step) / std::round(1.0 / step); }

void add_estimate(ordered_json& line, const SheetPosePercept& p) {
  line["yaw_deg"] = degrees(p.body.yaw_rad);
  line["x_m"] = p.body.x_m;
  line["y_m"] = p.body.y_m;
  line["hog_distance_m"] = p.hog_distance_m;
  line["sheet_width_m"] = p.sheet_width_m ? ordered_json(*p.sheet_width_m) : ordered_json(nullptr);
  line["eMc"] = p.eMc;
  line["sigma"] = {{"yaw_deg", degrees(p.sigma.yaw_rad)},
                   {"x_m", p.sigma.x_m},
                   {"y_m", p.sigma.y_m},
                   {"hog_distance_m", p.hog_distance_sigma_m}};
  line["residual_px"] = p.residual_px;
}

void add_nothing(ordered_json& line) {
  for (const char* key : {"yaw_deg", "x_m", "y_m", "hog_distance_m", "sheet_width_m", "eMc", "sigma", "residual_px"}) {
    line[key] = nullptr;
  }
}

ordered_json handle_json(const StoneSighting& s, double radians) {
  return s.handle_rad ? ordered_json(rounded(degrees(radians), 1e-2)) : ordered_json(nullptr);
}

ordered_json stone_json(const StoneSighting& s, const TeamNames& names) {
  return {{"x_m", s.x_m},
          {"y_m", s.y_m},
          {"team", team_name(s.team, names)},
          {"sigma_m", std::sqrt(std::max(s.covariance.xx_m2, s.covariance.yy_m2))},
          {"handle_deg", handle_json(s, s.handle_rad.value_or(0.0))},
          {"handle_sigma_deg", handle_json(s, s.handle_sigma_rad)}};
}

ordered_json stones_json(const std::vector<StoneSighting>& stones, const TeamNames& names) {
  ordered_json all = ordered_json::array();
  for (const StoneSighting& s : stones) all.push_back(stone_json(s, names));
  return all;
}

ordered_json known(const std::optional<double>& value, double step) {
  return value ? ordered_json(rounded(*value, step)) : ordered_json(nullptr);
}

ordered_json correction_json(const FarCorrection& c) {
  return {{"pan_deg", degrees(c.pan_rad)},
          {"tilt_deg", degrees(c.tilt_rad)},
          {"roll_deg", degrees(c.roll_rad)},
          {"pan_sigma_deg", degrees(c.pan_sigma_rad)},
          {"tilt_sigma_deg", degrees(c.tilt_sigma_rad)},
          {"roll_sigma_deg", degrees(c.roll_sigma_rad)}};
}

void finish(ordered_json& line, const std::string& reason, double elapsed_ms) {
  line["elapsed_ms"] = rounded(elapsed_ms, 1e-3);
  line["reason"] = reason.empty() ? ordered_json(nullptr) : ordered_json(reason);
}

std::string text_of(const ordered_json& line) {
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string team_name(Team team, const TeamNames& names) {
  switch (team) {
    case Team::first:
      return names.first;
    case Team::second:
      return names.second;
    case Team::unknown:
      break;
  }
  return "unknown";
}

std::string pose_line(const std::string& image, const SheetPosePercept& percept, double elapsed_ms) {
  ordered_json line;
  line["image"] = image;
  line["ok"] = percept.ok;
  if (percept.ok) {
    add_estimate(line, percept);
  } else {
    add_nothing(line);
  }
  line["features"] = percept.features;
  line["elapsed_ms"] = rounded(elapsed_ms, 1e-3);
  line["reason"] = percept.reason.empty() ? ordered_json(nullptr) : ordered_json(percept.reason);
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string stones_line(const std::string& image, const StonesPercept& percept, const TeamNames& names,
                        double elapsed_ms) {
  ordered_json line;
  line["image"] = image;
  line["ok"] = percept.ok;
  line["stones"] = stones_json(percept.stones, names);
  line["blur_px"] = known(percept.blur_px, 1e-2);
  line["noise"] = known(percept.noise, 1e-4);
  finish(line, percept.reason, elapsed_ms);
  return text_of(line);
}

std::string far_stones_line(const std::string& image, const FarPercept& percept, const TeamNames& names,
                            double elapsed_ms) {
  ordered_json line;
  line["image"] = image;
  line["ok"] = percept.ok;
  std::vector<StoneSighting> stones = percept.stones;
  for (StoneSighting& s : stones) s.covariance = whole_covariance(percept, s);
  line["stones"] = stones_json(stones, names);
  line["correction"] = percept.ok ? correction_json(percept.correction) : ordered_json(nullptr);
  line["features"] = percept.features;
  finish(line, percept.reason, elapsed_ms);
  return text_of(line);
}

std::string stones_sequence_line(int pictures, int frames, const std::vector<StoneSighting>& stones,
                                 const std::vector<LeftOut>& left_out, const std::string& reason,
                                 const TeamNames& names, double elapsed_ms) {
  ordered_json line;
  line["pictures"] = pictures;
  line["frames"] = frames;
  line["ok"] = frames > 0;
  line["stones"] = stones_json(stones, names);
  line["left_out"] = ordered_json::array();
  for (const LeftOut& picture : left_out)
    line["left_out"].push_back({{"image", picture.image}, {"reason", picture.reason}});
  finish(line, reason, elapsed_ms);
  return text_of(line);
}

}  // namespace hogline
