#include "src/campaign/plan.hpp"

#include <fmt/format.h>

#include <numbers>

#include "hw/sim/mixed_bits.hpp"
#include "src/campaign/tee_draw.hpp"
#include "src/config/config_error.hpp"

namespace hogline::campaign {
namespace {

using hw::sim::mixed_bits;

constexpr double deg = std::numbers::pi / 180.0;
constexpr double most_heading_deg = 8.0;
constexpr double least_speed_mps = 0.5;

// Each number of a shot has its own sequence.
enum class Part : std::uint64_t { speed = 1, heading, spin, turn };
double share_of(std::uint64_t seed, Part part) {
  return hw::sim::uniform_of(mixed_bits(mixed_bits(seed) + static_cast<std::uint64_t>(part)));
}

void check_span(const char* option, const Span& span, double low, double high, const char* unit) {
  if (span.low >= low && span.high <= high) return;
  throw config::ConfigError("command line", 0, option, to_string(span),
                            fmt::format("must lie within {} to {} {}", low, high, unit));
}

servo::Curl curl_of(Turn turn, double share) {
  if (turn == Turn::both) return share < 0.5 ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
  return turn == Turn::clockwise ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
}

config::ThrowerRig left_out(config::ThrowerRig rig, Without without) {
  switch (without) {
    case Without::nothing:
      break;
    case Without::refraction:
      for (auto* camera : {&*rig.rig.near_camera, &*rig.rig.low_camera}) {
        camera->ice.paint_depth_m = 0.0;
        camera->paint_depth_sigma_m = 0.0;
      }
      break;
    case Without::latency:
      rig.looks.compensated = false;
      break;
    case Without::tracking:  // not of the rig: request()
      break;
    case Without::visual_alignment:
      rig.thrower.alignment.method = servo::AlignmentMethod::look_then_gyro;
      break;
  }
  return rig;
}

}  // namespace

std::string_view to_string(Without without) {
  switch (without) {
    case Without::nothing:
      return "nothing";
    case Without::refraction:
      return "refraction";
    case Without::latency:
      return "latency";
    case Without::tracking:
      return "tracking";
    case Without::visual_alignment:
      return "visual-alignment";
  }
  return "";
}

std::optional<Without> parse_without(std::string_view word) {
  for (const Without without :
       {Without::nothing, Without::refraction, Without::latency, Without::tracking, Without::visual_alignment}) {
    if (word == to_string(without)) return without;
  }
  return std::nullopt;
}

std::string_view to_string(Turn turn) {
  switch (turn) {
    case Turn::clockwise:
      return "cw";
    case Turn::counter_clockwise:
      return "ccw";
    case Turn::both:
      return "both";
  }
  return "";
}

Plan::Plan(PlanText text)
    : text_(std::move(text)),
      rig_(left_out(config::parse_thrower_rig(text_.rig, "rig"), text_.without)),
      scenario_(text_.scenario, "scenario") {
  const bool in_pictures = text_.without == Without::refraction || text_.without == Without::tracking;
  if (in_pictures && text_.eyes == Eyes::oracle) {
    throw config::ConfigError("command line", 0, "--without", std::string(to_string(text_.without)),
                              "is left out in pictures: needs --seer rendered");
  }
  check_span("--speed", text_.speed_mps, least_speed_mps, rig_.thrower.limits.max_speed_mps,
             "m/s (limits.max_speed_mps)");
  check_span("--heading-deg", text_.heading_deg, -most_heading_deg, most_heading_deg, "degrees");
  check_span("--spin", text_.spin_radps, 0.0, rig_.gripper.max_spin_radps, "rad/s (gripper.max_spin_radps)");
}

Draw Plan::draw(int number) const {
  const std::uint64_t bits = mixed_bits(mixed_bits(text_.seed) + static_cast<std::uint64_t>(number));
  Draw draw{.number = number, .seed = bits >> 5U, .order = {}};  // 59 bits: a number that --seed takes
  draw.order = {.speed_mps = text_.speed_mps.at(share_of(draw.seed, Part::speed)),
                .heading_rad = text_.heading_deg.at(share_of(draw.seed, Part::heading)) * deg,
                .curl = curl_of(text_.turn, share_of(draw.seed, Part::turn)),
                .spin_radps = text_.spin_radps.at(share_of(draw.seed, Part::spin))};
  if (text_.tee_draws) {
    const servo::ReleaseConfig& release = rig_.thrower.release;
    draw.order = tee_draw(scenario_.draw(draw.seed), release.hog_distance_m, release.stone_x_m, draw.order.curl,
                          draw.order.spin_radps);
  }
  return draw;
}

ThrowRequest Plan::request(const Draw& draw) const {
  return {.rig = rig_,
          .scenario = scenario_.draw(draw.seed),
          .order = draw.order,
          .fault = std::nullopt,
          .eyes = text_.eyes,
          .low_by_lines = text_.without == Without::tracking,
          .follow_stone = true,
          .settle = true,
          .render_threads = 1};
}

}  // namespace hogline::campaign
