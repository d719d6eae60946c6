#include "src/rink_command.hpp"

#include <fmt/format.h>
#include <optional>
#include <thread>

#include "src/exit_status.hpp"
#include "src/live/input_lines.hpp"
#include "src/live/live_rink.hpp"
#include "src/live/process.hpp"
#include "src/live/truth_log.hpp"
#include "src/skip/skip_set.hpp"

namespace hogline {
namespace {

constexpr Duration period = std::chrono::milliseconds(1);
constexpr int rink_priority = 20;
constexpr Duration worth_telling = std::chrono::milliseconds(40);  // half of what the rigs allow a silent device
constexpr Duration telling_pause = std::chrono::seconds(1);

Stamp present() { return std::chrono::steady_clock::now(); }

void obey(const std::string& line, LiveRink& rink, bool& quit) {
  if (line == "again" || line == "again 0" || line == "again 1") {
    const bool done = rink.put_back(line == "again" ? std::nullopt : std::optional(line == "again 0" ? 0 : 1));
    tell("rink", done ? "again" : "refused", done ? "the robot stands in the hack" : "the robot or a stone moves");
  } else if (line == "quit") {
    quit = true;
  } else {
    tell("rink", "refused", "'" + line + "': there are again, again 0, again 1, quit");
  }
}

/// Robots see a late rink as silent devices: whoever asks why they stopped finds it here.
class Lateness {
 public:
  void passed(Stamp now) {
    const Duration stood = last_ ? now - *last_ : Duration{};
    last_ = now;
    if (stood < worth_telling || (told_ && now - *told_ < telling_pause)) return;
    told_ = now;
    tell("rink", "late",
         fmt::format("the machine kept the rink waiting for {:.0f} ms: robots see timeouts; give it less to do",
                     1e3 * seconds(stood)));
  }

 private:
  std::optional<Stamp> last_;
  std::optional<Stamp> told_;
};

void run_until_asked(LiveRink& rink, const TruthLog& log) {
  InputLines input;
  Lateness lateness;
  bool quit = false;
  bool told_lost = false;
  for (Stamp looked{}; !quit && !asked_to_end();) {
    rink.pass(present());
    lateness.passed(present());
    if (log.lost() && !told_lost) tell("rink", "truth lost", "--truth: lines could not be written");
    told_lost = log.lost();
    pump_told();
    if (present() - looked > std::chrono::milliseconds(20)) {
      looked = present();
      if (const auto line = input.line()) obey(*line, rink, quit);
    }
    std::this_thread::sleep_until(rink.now() + period);
  }
}

hw::sim::Scenario drawn(const RinkOptions& options) {
  hw::sim::Scenario scenario = load_skip_scenario(options.scenario, options.seed);
  if (options.camera_hz > 0.0) scenario.near_camera.rate_hz = scenario.low_camera.rate_hz = options.camera_hz;
  scenario.skip->far_camera.rate_hz = options.skip_hz;
  return scenario;
}

std::optional<config::SkipRig> skip_rig(const RinkOptions& options) {
  if (options.skip_rig.empty()) return std::nullopt;
  return config::load_skip_rig(options.skip_rig);
}

}  // namespace

int run_rink(const RinkOptions& options) {
  listen_for_the_end();
  const config::ThrowerRig rig = config::load_thrower_rig(options.rig);
  TruthLog log(options.truth);
  const bool first = run_first(rink_priority);
  LiveRink rink(rig, skip_rig(options), drawn(options), log, present());
  tell("rink", "ready", fmt::format("seed {}, {}", options.seed, first ? "runs first" : "runs as other programs do"));
  run_until_asked(rink, log);
  const bool written = log.flush();
  tell("rink", "end", written ? "" : "--truth: lines could not be written; what is in the file is not all");
  return written ? ExitStatus::success : ExitStatus::failed;
}

}  // namespace hogline
