#include "src/skip_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/exit_status.hpp"
#include "src/output/output_file.hpp"
#include "src/output/output_folder.hpp"
#include "src/skip/ice_file.hpp"
#include "src/skip/skip_report.hpp"
#include "src/skip/skip_set.hpp"
#include "src/stones_setup.hpp"
#include "src/throw_request.hpp"

namespace hogline {
namespace {

// One line a state, with the time at which it began.
class StateTeller {
 public:
  void operator()(double t_s, servo::SkipState state) {
    if (last_ && *last_ == state) return;
    last_ = state;
    fmt::print(stderr, "{:7.2f} s  {}\n", t_s, servo::to_string(state));
    std::fflush(stderr);
  }

 private:
  std::optional<servo::SkipState> last_;
};

SkipRequest request_of(const SkipOptions& options) {
  const config::SkipRig rig = load_skip_rig_or_practice(options.rig);
  const SkipEyes eyes = options.oracle ? SkipEyes::oracle : SkipEyes::vision;
  if (options.number >= 0) {
    const SkipSet set{.rig = rig,
                      .scenario = options.scenario,
                      .first_seed = options.seed,
                      .only = 0,
                      .eyes = eyes,
                      .far_hz = options.far_hz,
                      .near_hz = options.near_hz};
    return request_of(set, options.number);
  }
  SkipRequest request;
  request.rig = rig;
  request.scenario = load_skip_scenario(options.scenario, options.seed);
  set_rates(request.scenario, options.far_hz, options.near_hz);
  request.scene = draw_scene(*throw_kind(options.kind), request.scenario, options.seed);
  request.eyes = eyes;
  request.announced = !options.unannounced;
  request.ice = servo::IceModel(servo::IceModelConfig{}).estimate();
  return request;
}

}  // namespace

int run_skip(const SkipOptions& options) {
  const OutputFolder folder("--out", options.out);
  SkipRequest request = request_of(options);
  if (!options.ice.empty()) check_file("--ice", options.ice);
  if (!options.ice.empty()) request.ice = load_ice(options.ice).value_or(request.ice);
  if (options.oracle && !options.record.empty()) {
    throw config::ConfigError("command line", 0, "--record", options.record,
                              "the oracle looks at no pictures: leave --oracle out to record them");
  }
  std::optional<OutputFolder> record;
  if (!options.record.empty() &&
      std::filesystem::weakly_canonical(options.record) != std::filesystem::weakly_canonical(options.out))
    record.emplace("--record", options.record);
  request.record = options.record;
  if (!options.json_only) fmt::print(stderr, "on the simulated rink: no device of the rig is opened\n");
  SkipProgress progress;
  if (!options.json_only) progress = StateTeller();
  const SkipOutcome outcome = follow_throw(request, progress);
  const ToldThrow told = told_of(outcome, request);
  write_throw(options.out, told);
  if (!options.ice.empty() && outcome.report.result.track) save_ice(options.ice, outcome.ice);
  if (!options.json_only) fmt::print(stderr, "result, trajectory and the sheet from above are in {}\n", options.out);
  fmt::print("{}\n", throw_json(told, -1));
  return outcome.report.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

int run_skips(const SkipsOptions& options) {
  const OutputFolder folder("--out", options.out);
  SkipSet set{.rig = load_skip_rig_or_practice(options.rig),
              .scenario = options.scenario,
              .first_seed = options.seed,
              .only = options.only,
              .eyes = options.oracle ? SkipEyes::oracle : SkipEyes::vision,
              .far_hz = options.far_hz,
              .near_hz = options.near_hz,
              .jobs = options.jobs};
  const bool all_well = run_set(set, options.out);
  return all_well ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
