#include "src/team_setup.hpp"

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/skip/skip_set.hpp"
#include "src/throw_request.hpp"

namespace hogline {
namespace {

constexpr double oracle_hz = 20.0;
constexpr double rendered_hz = 6.0;

}  // namespace

TeamRequest team_request(const TeamOptions& options) {
  TeamRequest request;
  request.thrower = options.rig.empty()
                        ? config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig")
                        : config::load_thrower_rig(options.rig);
  request.skip = load_skip_rig_or_practice(options.skip_rig);
  request.scenario = load_skip_scenario(options.scenario, options.seed);
  request.eyes = eyes_of(options.seer);
  if (request.thrower.drive.timing.control_period != request.skip.head.timing.control_period) {
    throw config::ConfigError("command line", 0, "--skip-rig", options.skip_rig,
                              "must have the thrower's control period: both are stepped together");
  }
  request.skip_hz = request.eyes == Eyes::oracle ? oracle_hz : rendered_hz;
  if (options.skip_hz > 0.0) request.skip_hz = options.skip_hz;
  return request;
}

}  // namespace hogline
