#include "src/far_looker.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

constexpr double farthest_m = 100.0;  // from the tee: any rink
constexpr double most_yaw_deg = 360.0;

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(const std::string& text, const std::string& problem) {
  throw config::ConfigError("command line", 0, "--at", text,
                            problem +
                                "; give the body's place and direction as X_M,Y_M,YAW_DEG, for example "
                                "--at=-0.15,-3.51,1.1");
}

}  // namespace

PlanarPose parse_at(const std::string& text) {
  std::array<double, 3> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool last = i + 1 == numbers.size();
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != last) refuse(text, "must be three numbers with commas between them");
    const std::string_view part = rest.substr(0, comma);
    const std::optional<double> value = number(part);
    if (!value) refuse(text, "'" + std::string(part) + "' is no number");
    numbers[i] = *value;
    if (!last) rest.remove_prefix(comma + 1);
  }
  if (std::abs(numbers[0]) > farthest_m || std::abs(numbers[1]) > farthest_m) {
    refuse(text, "no place on a rink is more than 100 m from the tee");
  }
  if (std::abs(numbers[2]) > most_yaw_deg) refuse(text, "the direction must lie between -360 and 360 degrees");
  return {numbers[0], numbers[1], numbers[2] * std::numbers::pi / 180.0};
}

vision::FarSetup far_setup(const config::Rig& rig) {
  vision::FarSetup setup;
  setup.camera = rig.camera("far");
  setup.shape.handle_radius_m = rig.stone.radius_m;
  setup.shape.handle_height_m = rig.stone.height_m;
  setup.shape.rim_rounding_m = rig.stone.rim_rounding_m;
  setup.teams = {.first_rad = rig.stone.teams[0].hue_rad, .second_rad = rig.stone.teams[1].hue_rad};
  return setup;
}

vision::FarPlan far_plan(const vision::CameraSetup& camera, const PlanarPose& body) {
  vision::FarPlan plan;
  plan.eMc = vision::eMb(body) * vision::bMc(camera.mount);
  return plan;
}

}  // namespace hogline
