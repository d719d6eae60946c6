#include "src/team/throw_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hogline {
namespace {

std::string number_or_nothing(bool is, double value) { return is ? fmt::format("{:.5f}", value) : ""; }

const char* word(game::ThrowEnd end) {
  constexpr std::array<const char*, 3> words{"thrown", "refused", "failed"};
  return words[static_cast<std::size_t>(end)];
}

double sigma_of(const PlaceCovariance& c) { return std::sqrt(c.xx_m2 + c.yy_m2); }

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

double worst_place_m(const TurnRecord& r) {
  double worst = 0.0;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto &s = r.report.seen.lying.stones[side][i], &t = r.truth.stones.lying.stones[side][i];
      if (s && t) worst = std::max(worst, std::hypot(s->x_m - t->x_m, s->y_m - t->y_m));
    }
  }
  return worst;
}

std::string throw_header() {
  return "end,shot,team,outcome,attempts,plan,speed_mps,heading_rad,release_place_mm,release_speed_mps,"
         "release_heading_deg,release_lateral_mm,struck_seen,struck_true,worst_place_m,foretold_error_m,"
         "foretold_sigma_m,learnt_from,friction_scale,friction_sigma,curl_gain,curl_sigma,simulated_s,wall_s,remarks\n";
}

std::string throw_row(const TurnRecord& r, int end, int shot) {
  const auto& release = r.thrower.release;
  std::string remarks = fmt::format("{}", fmt::join(r.remarks, "; "));
  std::ranges::replace(remarks, ',', ';');
  const auto& c = r.ice.covariance;
  return fmt::format(
      "{},{},{},{},{},{},{:.4f},{:.5f},{},{},{},{},{:d},{:d},{:.4f},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f},{:.2f},"
      "{}\n",
      end, shot, servo::side_of(r.turn.team), word(r.report.end), r.attempts, r.turn.decision.plan,
      r.report.order.speed_mps, r.report.order.heading_rad,
      number_or_nothing(release.has_value(),
                        release ? 1e3 * (release->hog_distance_m - release->target_hog_distance_m) : 0.0),
      number_or_nothing(release.has_value(), release ? release->speed_error_mps : 0.0),
      number_or_nothing(release.has_value(), release ? release->heading_error_rad * 57.29577951308232 : 0.0),
      number_or_nothing(release.has_value(), release ? 1e3 * release->lateral_error_m : 0.0), r.report.seen.struck,
      r.truth.stones.struck, worst_place_m(r),
      number_or_nothing(r.lesson.has_value(), r.lesson ? r.lesson->error_m() : 0.0),
      number_or_nothing(r.lesson.has_value(), r.lesson ? sigma_of(r.lesson->foretold.covariance) : 0.0),
      r.lesson ? r.lesson->before.throws : r.ice.throws, r.ice.friction_scale, std::sqrt(c[0]), r.ice.curl_gain,
      std::sqrt(c[4]), r.simulated_s, r.wall_s, remarks);
}

std::string figures_table(const TruthFigures& f, const std::vector<TurnRecord>& records) {
  double simulated_s = 0.0, wall_s = 0.0;
  for (const TurnRecord& r : records) simulated_s += r.simulated_s, wall_s += r.wall_s;
  const auto measures = std::ranges::count(f.disagreements, true, &Disagreement::a_measure);
  std::string t = "| figure | value |\n|---|--:|\n";
  const auto row = [&t](const char* what, const std::string& value) {
    fmt::format_to(std::back_inserter(t), "| {} | {} |\n", what, value);
  };
  row("ends, throws", fmt::format("{}, {}", f.ends, f.throws));
  row("disagreements with the truth", std::to_string(f.disagreements.size() - static_cast<std::size_t>(measures)));
  row("... that truth decides by less than 2 cm", std::to_string(measures));
  row("ends that truth decides by less than 2 cm", std::to_string(f.measures));
  row("stones given away", std::to_string(f.given_away));
  row("attempts repeated", std::to_string(f.repeated));
  row("throws with a remark of the skip's", std::to_string(f.unfollowed));
  row("throws that struck a stone; told wrongly", fmt::format("{}; {}", f.collisions, f.struck_wrong));
  row("stones' places, seen less true, RMS / worst [mm]",
      fmt::format("{:.1f} / {:.1f}", f.places > 0 ? 1e3 * std::sqrt(f.square_m2 / f.places) : 0.0, 1e3 * f.worst_m));
  row("simulated s a throw; times real time",
      fmt::format("{:.1f}; {:.1f}", simulated_s / std::max(1.0, static_cast<double>(records.size())),
                  wall_s > 0.0 ? simulated_s / wall_s : 0.0));
  return t;
}

std::string figures_json(const TruthFigures& f, const std::vector<TurnRecord>& records) {
  double simulated_s = 0.0, wall_s = 0.0;
  for (const TurnRecord& r : records) simulated_s += r.simulated_s, wall_s += r.wall_s;
  const auto measures = std::ranges::count(f.disagreements, true, &Disagreement::a_measure);
  return fmt::format(
      "{{\"turns\":{},\"ends\":{},\"throws\":{},\"disagreements\":{},\"too_close_disagreements\":{},\"too_close_ends\":"
      "{},"
      "\"given_away\":{},\"repeated\":{},\"remarked\":{},\"struck\":{},\"struck_wrong\":{},\"places\":{},"
      "\"square_m2\":{},\"worst_m\":{},\"simulated_s\":{},\"wall_s\":{}}}\n",
      records.size(), f.ends, f.throws, f.disagreements.size() - static_cast<std::size_t>(measures), measures,
      f.measures, f.given_away, f.repeated, f.unfollowed, f.collisions, f.struck_wrong, f.places, f.square_m2,
      f.worst_m, simulated_s, wall_s);
}

std::string ice_table(const std::vector<TurnRecord>& records) {
  constexpr std::array<int, 6> from{0, 1, 2, 4, 8, 16};
  std::string t = "| learnt from | stones | error RMS [m] | foretold sigma, mean [m] |\n|---|--:|--:|--:|\n";
  for (std::size_t k = 0; k < from.size(); ++k) {
    const int to = k + 1 < from.size() ? from[k + 1] : 1 << 30;
    std::vector<double> errors;
    double sigma = 0.0;
    for (const TurnRecord& r : records) {
      if (!r.lesson || r.lesson->before.throws < from[k] || r.lesson->before.throws >= to) continue;
      errors.push_back(r.lesson->error_m());
      sigma += sigma_of(r.lesson->foretold.covariance);
    }
    if (errors.empty()) continue;
    const std::string range = to == from[k] + 1 ? std::to_string(from[k])
                              : to == 1 << 30   ? fmt::format("{} and more", from[k])
                                                : fmt::format("{} to {}", from[k], to - 1);
    fmt::format_to(std::back_inserter(t), "| {} throws | {} | {:.3f} | {:.3f} |\n", range, errors.size(),
                   root_mean_square(errors), sigma / static_cast<double>(errors.size()));
  }
  return t;
}

}  // namespace hogline
