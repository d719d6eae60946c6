#include "src/campaign/plan.hpp"

#include <fmt/format.h>

#include <numbers>

#include "hw/sim/mixed_bits.hpp"
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

}  // namespace

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
    : text_(std::move(text)), rig_(config::parse_thrower_rig(text_.rig, "rig")), scenario_(text_.scenario, "scenario") {
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
  return draw;
}

ThrowRequest Plan::request(const Draw& draw) const {
  return {.rig = rig_,
          .scenario = scenario_.draw(draw.seed),
          .order = draw.order,
          .fault = std::nullopt,
          .eyes = text_.eyes,
          .follow_stone = true,
          .render_threads = 1};
}

}  // namespace hogline::campaign
