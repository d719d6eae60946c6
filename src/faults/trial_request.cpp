#include "src/faults/trial_request.hpp"

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"

namespace hogline::faults {
namespace {

ThrowRequest plain_request() {
  constexpr std::uint64_t seed = 5;
  return {
      .rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig"),
      .scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", seed),
      .order = {.speed_mps = trial_speed_mps,
                .heading_rad = 0.0,
                .curl = servo::Curl::counter_clockwise,
                .spin_radps = 1.5},
      .fault = std::nullopt,
      .eyes = Eyes::oracle,
      .follow_stone = false};
}

ThrowRequest prepared(const Case& fault, ThrowRequest request) {
  if (fault.prepare) fault.prepare(request);
  request.rig = with_small_pictures(std::move(request.rig));
  return request;
}

}  // namespace

ThrowRequest request_of(const Case& fault) { return prepared(fault, plain_request()); }

ThrowRequest request_of(const Case& fault, const Moment& moment) {
  ThrowRequest request = plain_request();
  request.scenario =
      config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", moment.seed);
  request.order = moment.order;
  return prepared(fault, std::move(request));
}

}  // namespace hogline::faults
