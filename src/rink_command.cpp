#include "src/rink_command.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <thread>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/config/strict_yaml.hpp"
#include "src/exit_status.hpp"
#include "src/live/live_rink.hpp"
#include "src/live/process.hpp"

namespace hogline {
namespace {

constexpr Duration period = std::chrono::milliseconds(1);
constexpr int rink_priority = 20;

Stamp present() { return std::chrono::steady_clock::now(); }

config::ScenarioFile scenario_file(const std::string& path) {
  if (!path.empty()) return {config::read_file(path), path};
  return {config::embedded_file("scenarios/practice.yaml"), "practice scenario"};
}

// Words on stdin, a line each; whoever closes it has nothing more to say.
class Stdin {
 public:
  std::optional<std::string> line() {
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    if (open_ && poll(&waiting, 1, 0) == 1) {
      std::array<char, 256> bytes{};
      const auto got = read(STDIN_FILENO, bytes.data(), bytes.size());
      open_ = got > 0;
      if (open_) said_.append(bytes.data(), static_cast<std::size_t>(got));
    }
    const auto end = said_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    const std::string line = said_.substr(0, end);
    said_.erase(0, end + 1);
    return line;
  }

 private:
  bool open_ = true;
  std::string said_;
};

enum class Wish { again, quit };

Wish run_until_asked(LiveRink& rink, Stdin& input) {
  for (Stamp looked{}; !asked_to_end();) {
    rink.pass(present());
    if (present() - looked > std::chrono::milliseconds(20)) {
      looked = present();
      const auto line = input.line();
      if (line && (*line == "again" || *line == "quit")) return *line == "again" ? Wish::again : Wish::quit;
      if (line) tell("rink", "refused", "'" + *line + "': there are again, quit");
    }
    std::this_thread::sleep_until(rink.now() + period);
  }
  return Wish::quit;
}

hw::sim::Scenario drawn(const config::ScenarioFile& file, const RinkOptions& options, std::uint64_t seed) {
  hw::sim::Scenario scenario = file.draw(seed);
  if (options.camera_hz > 0.0) scenario.near_camera.rate_hz = scenario.low_camera.rate_hz = options.camera_hz;
  return scenario;
}

}  // namespace

int run_rink(const RinkOptions& options) {
  listen_for_the_end();
  const config::ThrowerRig rig = config::load_thrower_rig(options.rig);
  const config::ScenarioFile scenarios = scenario_file(options.scenario);
  TruthLog log(options.truth);
  Stdin input;
  const bool first = run_first(rink_priority);
  for (std::uint64_t seed = options.seed;; ++seed) {
    LiveRink rink(rig, drawn(scenarios, options, seed), log, present());
    tell("rink", "ready", fmt::format("seed {}, {}", seed, first ? "runs first" : "runs as other programs do"));
    if (run_until_asked(rink, input) == Wish::quit) break;
  }
  tell("rink", "end", "");
  return ExitStatus::success;
}

}  // namespace hogline
