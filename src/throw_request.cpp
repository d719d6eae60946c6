#include "src/throw_request.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/realtime_throw.hpp"
#include "src/throwing_report.hpp"

namespace hogline {
namespace {

void check_number(const char* option, double value, double low, double high, const char* unit) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  throw config::ConfigError("command line", 0, option, fmt::format("{}", value),
                            fmt::format("must be a number from {} to {} {}", low, high, unit));
}

// One line a state, with the time at which it began; nothing more often, so that a log file stays readable.
class StateTeller {
 public:
  void operator()(double t_s, servo::ThrowerState state) {
    if (last_ && *last_ == state) return;
    last_ = state;
    fmt::print(stderr, "{:7.2f} s  {}\n", t_s, servo::to_string(state));
    std::fflush(stderr);
  }

 private:
  std::optional<servo::ThrowerState> last_;
};

}  // namespace

void check_folder(const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (folder.empty() || error || ::access(folder.c_str(), W_OK) != 0) {
    throw config::ConfigError("command line", 0, "--out", folder, "must be a folder that can be written to");
  }
}

Eyes eyes_of(const std::string& seer) { return seer == "oracle" ? Eyes::oracle : Eyes::vision; }

// The folder before the throw, not after it.
ThrowRequest make_request(const ThrowOptions& options) {
  check_folder(options.out);
  ThrowRequest request;
  request.rig = options.rig.empty()
                    ? config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig")
                    : config::load_thrower_rig(options.rig);
  request.scenario = options.scenario.empty() ? config::parse_scenario(config::embedded_file("scenarios/practice.yaml"),
                                                                       "practice scenario", options.seed)
                                              : config::load_scenario(options.scenario, options.seed);

  check_number("--speed", options.speed_mps, 0.5, request.rig.thrower.limits.max_speed_mps,
               "m/s (limits.max_speed_mps)");
  check_number("--heading-deg", options.heading_deg, -8.0, 8.0, "degrees");
  check_number("--spin", options.spin_radps, 0.0, request.rig.gripper.max_spin_radps, "rad/s (gripper.max_spin_radps)");
  request.order = {.speed_mps = options.speed_mps,
                   .heading_rad = options.heading_deg * std::numbers::pi / 180.0,
                   .curl = options.curl == "cw" ? servo::Curl::clockwise : servo::Curl::counter_clockwise,
                   .spin_radps = options.spin_radps};
  request.eyes = eyes_of(options.seer);
  if (!options.fault.empty()) request.fault = parse_fault(options.fault);
  return request;
}

ThrowOutcome carry_out(const ThrowOptions& options, const ThrowRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  ThrowOutcome outcome =
      options.realtime ? throw_in_real_time(request, StateTeller()) : throw_stone(request, StateTeller());
  outcome.result.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_report(options.out, request, outcome);
  return outcome;
}

}  // namespace hogline
