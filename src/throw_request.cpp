#include "src/throw_request.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/output/output_file.hpp"
#include "src/throwing/realtime_throw.hpp"
#include "src/throwing/release_memory.hpp"
#include "src/throwing_report.hpp"

namespace hogline {
namespace {

void check_number(const char* option, double value, double low, double high, const char* unit) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  throw config::ConfigError("command line", 0, option, fmt::format("{}", value),
                            fmt::format("must be a number from {} to {} {}", low, high, unit));
}

servo::ReleaseKnowledge known(const std::string& path, const servo::ReleaseConfig& config) {
  return load_release_knowledge(path).value_or(servo::prior_of(config));
}

// The jaws tell of their delay; of the stone's speed the skip that tracks it tells. On the simulated rink its report is
// the truth with the scatter of such a track.
servo::ReleaseFeedback feedback_of(const ThrowResult& result, const servo::ShotOrder& order, std::uint64_t seed) {
  constexpr double delay_sigma_s = 0.0025;  // jitter of the jaws, and their polled travel
  constexpr double track_sigma_mps = 0.010;
  servo::ReleaseFeedback feedback;
  if (result.measured_delay_s) feedback.delay_s = result.measured_delay_s;
  feedback.delay_sigma_s = delay_sigma_s;
  if (result.release && result.freed_at_speed_mps) {
    std::mt19937_64 random(seed);
    const double tracked_mps = order.speed_mps + result.release->speed_error_mps +
                               track_sigma_mps * std::normal_distribution<double>()(random);
    feedback.drag_mps = *result.freed_at_speed_mps - tracked_mps;
    feedback.drag_sigma_mps = track_sigma_mps;
  }
  return feedback;
}

void keep_lesson(const std::string& path, const ThrowRequest& request, const ThrowResult& result) {
  if (!result.release) return;  // nothing was let go: nothing was learnt
  const servo::ReleaseKnowledge before = known(path, request.rig.thrower.release);
  const auto lesson = servo::learn(before, feedback_of(result, request.order, request.scenario.seed));
  if (!lesson.refused.empty()) fmt::print(stderr, "not learnt: {}\n", lesson.refused);
  save_release_knowledge(path, lesson.knowledge);
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

Eyes eyes_of(const std::string& seer) { return seer == "oracle" ? Eyes::oracle : Eyes::vision; }

ThrowRequest make_request(const ThrowOptions& options) {
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
  if (!options.learn.empty()) {
    check_file("--learn", options.learn);
    request.rig.thrower.release =
        servo::with_knowledge(request.rig.thrower.release, known(options.learn, request.rig.thrower.release));
  }
  request.eyes = eyes_of(options.seer);
  if (!options.fault.empty()) request.fault = parse_fault(options.fault);
  return request;
}

ThrowOutcome carry_out(const ThrowOptions& options, const ThrowRequest& request) {
  fmt::print(stderr, "on the simulated rink: no device of the rig is opened\n");
  const auto begin = std::chrono::steady_clock::now();
  ThrowOutcome outcome =
      options.realtime ? throw_in_real_time(request, StateTeller()) : throw_stone(request, StateTeller());
  outcome.result.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_report(options.out, request, outcome);
  if (outcome.result.fault_struck == false) {
    fmt::print(stderr, "the fault never struck: there was no run, or it was over before\n");
  }
  if (!options.learn.empty()) keep_lesson(options.learn, request, outcome.result);
  return outcome;
}

}  // namespace hogline
