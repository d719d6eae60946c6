#include "src/skip/skip_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <mutex>
#include <random>
#include <thread>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/output/output_file.hpp"
#include "src/skip/skip_figures.hpp"
#include "src/stones_setup.hpp"

namespace hogline {
namespace {

constexpr double occlusion_s = 2.0;

struct Part {
  ThrowKind kind;
  int throws;
};
constexpr Part parts[] = {{ThrowKind::draw, 12},      {ThrowKind::guard, 6},   {ThrowKind::hit, 8},
                          {ThrowKind::double_hit, 6}, {ThrowKind::through, 4}, {ThrowKind::hogged, 4}};

ThrowKind kind_of(int number) {
  for (const Part& part : parts) {
    if (number < part.throws) return part.kind;
    number -= part.throws;
  }
  return ThrowKind::draw;
}

/// Figures of all throws together.
struct Sum {
  int throws = 0;
  int failed = 0;
  RootMeanSquare aim_deg;
  double worst_aim_rms_deg = 0.0;
  double room_deg = 1e9;
  int occlusions = 0;
  int settled = 0;
  RegionErrors trajectory;
  RegionErrors live;
  RootMeanSquare hog_to_hog_s;
  double worst_hog_to_hog_s = 0.0;
  RootMeanSquare spin_radps;
  RootMeanSquare spin_sigmas;
  double worst_spin_radps = 0.0;
  RootMeanSquare rest_m;
  double worst_rest_m = 0.0;
  int collisions = 0;
  int missed = 0;
  int invented = 0;
  int swaps = 0;
  int wrong_fates = 0;

  void add(const SkipFigures& f) {
    ++throws;
    failed += f.failed.empty() ? 0 : 1;
    aim_deg.add(f.aim_deg);
    worst_aim_rms_deg = std::max(worst_aim_rms_deg, f.aim_deg.value());
    room_deg = std::min(room_deg, f.room_deg);
    for (const double s : f.settle_s) ++occlusions, settled += s <= 1.0 ? 1 : 0;
    trajectory.add(f.trajectory);
    live.add(f.live);
    if (f.hog_to_hog_error_s) {
      hog_to_hog_s.add(*f.hog_to_hog_error_s);
      worst_hog_to_hog_s = std::max(worst_hog_to_hog_s, std::abs(*f.hog_to_hog_error_s));
    }
    if (f.spin_error_radps) {
      spin_radps.add(*f.spin_error_radps);
      spin_sigmas.add(*f.spin_error_radps / f.spin_sigma_radps);
      worst_spin_radps = std::max(worst_spin_radps, std::abs(*f.spin_error_radps));
    }
    for (const double e : f.rest_errors_m) rest_m.add(e), worst_rest_m = std::max(worst_rest_m, e);
    collisions += f.true_collisions;
    missed += f.missed_collisions;
    invented += f.invented_collisions;
    swaps += f.swaps;
    wrong_fates += f.wrong_fates;
  }
  bool well() const { return failed + missed + invented + swaps + wrong_fates == 0 && room_deg > 0.0; }
};

Sum sum_of(const std::vector<std::optional<SkipFigures>>& figures) {
  Sum sum;
  for (const auto& f : figures) {
    if (f) sum.add(*f);
  }
  return sum;
}

std::string table(const Sum& s, const SkipSet& set, const SkipRequest& example) {
  const double far_hz = example.scenario.skip->far_camera.rate_hz, near_hz = example.scenario.near_camera.rate_hz;
  std::string t = fmt::format(
      "{} throws seen by {}, far camera {:.0f} Hz, near camera {:.0f} Hz\n\n| figure | asked for | reached "
      "|\n|---|---|---|\n",
      s.throws, set.eyes == SkipEyes::oracle ? "the oracle" : "vision in rendered pictures", far_hz, near_hz);
  const auto row = [&t](const char* what, const char* asked, const std::string& reached) {
    fmt::format_to(std::back_inserter(t), "| {} | {} | {} |\n", what, asked, reached);
  };
  const auto mm = [](const RootMeanSquare& r) { return fmt::format("{:.0f}", 1000.0 * r.value()); };
  row("throws followed to their end without a remark", "all", fmt::format("{} of {}", s.throws - s.failed, s.throws));
  row("stone off the far view's middle, RMS of the worst throw / of all [deg]", "0.25",
      fmt::format("{:.3f} / {:.3f}", s.worst_aim_rms_deg, s.aim_deg.value()));
  row("least way of a joint to its limit [deg]", "> 0", fmt::format("{:.1f}", s.room_deg));
  row("settled within 1 s after 2 s hidden", "all", fmt::format("{} of {}", s.settled, s.occlusions));
  row("identities swapped", "0", std::to_string(s.swaps));
  row("place in the house, trajectory / live, RMS [mm]", "15", mm(s.trajectory.house_m) + " / " + mm(s.live.house_m));
  row("place within 2 m beyond the near hog line [mm]", "60",
      mm(s.trajectory.near_hog_m) + " / " + mm(s.live.near_hog_m));
  row("place within 2 m before the far hog line [mm]", "150",
      mm(s.trajectory.far_hog_m) + " / " + mm(s.live.far_hog_m));
  row("hog to hog, RMS / worst [s]", "0.05",
      fmt::format("{:.3f} / {:.3f}", s.hog_to_hog_s.value(), s.worst_hog_to_hog_s));
  row("rate of turn, measured in / RMS / worst [rad/s] / RMS in sigmas", "-",
      fmt::format("{} of {} / {:.3f} / {:.3f} / {:.1f}", s.spin_radps.count, s.throws, s.spin_radps.value(),
                  s.worst_spin_radps, s.spin_sigmas.value()));
  row("resting place of stones that moved, RMS / worst [mm]", "15",
      mm(s.rest_m) + fmt::format(" / {:.0f}", 1000.0 * s.worst_rest_m));
  row("collisions missed", "0", fmt::format("{} of {}", s.missed, s.collisions));
  row("collisions invented", "0", std::to_string(s.invented));
  row("out, through, hogged: wrong", "0", std::to_string(s.wrong_fates));
  return t;
}

std::string csv_header() {
  return "number,kind,seed,announced,ok,aim_rms_deg,aim_worst_deg,settle_s,trajectory_house_m,trajectory_near_hog_m,"
         "trajectory_far_hog_m,live_house_m,live_near_hog_m,live_far_hog_m,hog_to_hog_error_s,spin_error_radps,spin_"
         "sigma_radps,worst_rest_m,"
         "collisions,"
         "missed,invented,swaps,wrong_fates,reason\n";
}

std::string csv_line(int number, const SkipRequest& request, const SkipFigures& f) {
  double rest_m = 0.0, settle_s = 0.0;
  for (const double e : f.rest_errors_m) rest_m = std::max(rest_m, e);
  for (const double s : f.settle_s) settle_s = std::max(settle_s, s);
  std::string reason = f.failed;
  std::replace(reason.begin(), reason.end(), ',', ';');
  return fmt::format(
      "{},{},{},{},{},{:.4f},{:.4f},{:.2f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{},{:.4f},{},{},{},{},{},{}"
      "\n",
      number, throw_kind_names()[static_cast<std::size_t>(kind_of(number))], request.scenario.seed,
      request.announced ? 1 : 0, f.failed.empty() ? 1 : 0, f.aim_deg.value(), f.worst_aim_deg, settle_s,
      f.trajectory.house_m.value(), f.trajectory.near_hog_m.value(), f.trajectory.far_hog_m.value(),
      f.live.house_m.value(), f.live.near_hog_m.value(), f.live.far_hog_m.value(),
      f.hog_to_hog_error_s ? fmt::format("{:.4f}", *f.hog_to_hog_error_s) : "",
      f.spin_error_radps ? fmt::format("{:.4f}", *f.spin_error_radps) : "",
      f.spin_error_radps ? fmt::format("{:.4f}", f.spin_sigma_radps) : "", rest_m, f.true_collisions,
      f.missed_collisions, f.invented_collisions, f.swaps, f.wrong_fates, reason);
}

}  // namespace

config::SkipRig load_skip_rig_or_practice(const std::string& path) {
  return path.empty() ? config::parse_skip_rig(config::embedded_file("rigs/skip.yaml"), "practice skip")
                      : config::load_skip_rig(path);
}

hw::sim::Scenario load_skip_scenario(const std::string& path, std::uint64_t seed) {
  const auto scenario =
      path.empty() ? config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", seed)
                   : config::load_scenario(path, seed);
  if (!scenario.skip) {
    throw config::ConfigError(path, 0, "skip", "", "missing; the scenario must say where the skip stands");
  }
  return scenario;
}

void set_rates(hw::sim::Scenario& scenario, double far_hz, double near_hz) {
  if (far_hz > 0.0) scenario.skip->far_camera.rate_hz = far_hz;
  if (near_hz > 0.0) scenario.near_camera.rate_hz = near_hz;
}

ToldThrow told_of(const SkipOutcome& outcome, const SkipRequest& request) {
  ToldThrow told;
  told.report = &outcome.report;
  told.known = &outcome.known;
  told.origin = outcome.released.value_or(Stamp{});
  told.ice = outcome.ice;
  for (const SkipSample& s : outcome.samples) {
    if (s.stop && s.truth.y_m > servo::hog_line_m) told.foretold = s.stop;
  }
  told.teams = team_names(request.rig.rig);
  told.seen_by = request.eyes == SkipEyes::oracle ? "oracle" : "vision";
  told.truth = &outcome;
  return told;
}

SkipRequest request_of(const SkipSet& set, int number) {
  const std::uint64_t seed = set.first_seed + static_cast<std::uint64_t>(number);
  SkipRequest request;
  request.rig = set.rig;
  request.scenario = load_skip_scenario(set.scenario, seed);
  set_rates(request.scenario, set.far_hz, set.near_hz);
  request.eyes = set.eyes;
  request.announced = number % 2 == 0;
  std::mt19937_64 random(seed * 104729 + 7);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  request.scenario.stone.friction_scale = between(0.85, 1.2);
  request.scenario.stone.curl_gain = between(0.6, 1.1);
  request.scenario.stone.lateral_acceleration_mps2 = between(-3e-4, 3e-4);
  request.scenario.stone.restitution = between(0.8, 0.95);
  request.scenario.stone.stone_friction = between(0.05, 0.2);
  request.scenario.skip->passers = {{between(3.0, 16.0), occlusion_s}};
  request.scene = draw_scene(kind_of(number), request.scenario, seed);
  request.ice = servo::IceModel(servo::IceModelConfig{}).estimate();
  return request;
}

bool run_set(const SkipSet& set, const std::string& folder) {
  const int count = set.only > 0 ? std::min(set.only, throws_in_set) : throws_in_set;
  const SkipRequest example = request_of(set, 0);
  std::vector<std::optional<SkipFigures>> figures(static_cast<std::size_t>(count));
  std::vector<std::string> rows(figures.size());
  std::atomic<std::size_t> next = 0;
  std::mutex table_mutex;
  const auto work = [&] {
    for (std::size_t k = next++; k < figures.size(); k = next++) {
      // A part of the set is spread over it.
      const int number = static_cast<int>(k) * throws_in_set / count;
      const SkipRequest request = request_of(set, number);
      const SkipFigures f = figures_of(follow_throw(request));
      const std::lock_guard lock(table_mutex);
      figures[k] = f;
      rows[k] = csv_line(number, request, f);
      fmt::print(stderr, "{}", rows[k]);
      write_text(folder + "/throws.csv", csv_header() + fmt::format("{}", fmt::join(rows, "")));
      const std::string text = table(sum_of(figures), set, example);
      write_text(folder + "/table.md", text);
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < set.jobs; ++i) helpers.emplace_back(work);
    work();
  }
  const Sum sum = sum_of(figures);
  fmt::print("{}", table(sum, set, example));
  return sum.well();
}

}  // namespace hogline
