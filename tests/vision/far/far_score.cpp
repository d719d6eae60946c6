#include "tests/vision/far/far_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hogline::vision::testing {
namespace {

using hogline::testing::BoardStone;
using hogline::testing::FarScene;

constexpr double same_across_m = 0.2;
constexpr double same_along_m = 0.6;
constexpr double most_sigmas = 4.0;  // off by more is listed

bool in_sight(const BoardStone& s) { return s.handle_seen >= 0.5 && s.handle_seen + s.body_seen >= 1.6; }

void add_tilt(const FarScene& far, const FarPercept& seen, FarScore& score) {
  const Eigen::AngleAxisd off(from_row_major(seen.eMc).linear() * far.scene.eMc.linear().transpose());
  const double tilt = -(off.angle() * off.axis()).x();
  score.tilt_rad.push_back(tilt);
  score.tilt_sigmas.push_back(tilt / seen.correction.tilt_sigma_rad);
}

/// A stone of the truth and a sighting that may be of it.
struct Pairing {
  std::size_t stone, sighting;
  double distance;
};

// The closest first: else a stone that was missed takes its neighbour's sighting, and the neighbour's team and place.
std::vector<Pairing> paired(const std::vector<BoardStone>& truth, const std::vector<StoneSighting>& seen) {
  std::vector<Pairing> possible;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t j = 0; j < seen.size(); ++j) {
      const double distance =
          std::hypot((seen[j].x_m - truth[i].x_m) / same_across_m, (seen[j].y_m - truth[i].y_m) / same_along_m);
      if (distance < 1.0) possible.push_back({i, j, distance});
    }
  }
  std::sort(possible.begin(), possible.end(),
            [](const Pairing& a, const Pairing& b) { return a.distance < b.distance; });
  std::vector<Pairing> pairs;
  for (const Pairing& p : possible) {
    const bool taken = std::any_of(pairs.begin(), pairs.end(), [&p](const Pairing& other) {
      return other.stone == p.stone || other.sighting == p.sighting;
    });
    if (!taken) pairs.push_back(p);
  }
  return pairs;
}

void add_errors(const std::string& what, const BoardStone& t, const StoneSighting& s, const PlaceCovariance& whole,
                FarScore& score) {
  const double across_m = s.x_m - t.x_m;
  const double along_m = s.y_m - t.y_m;
  const double across_sigmas = across_m / std::sqrt(whole.xx_m2);
  const double along_sigmas = along_m / std::sqrt(whole.yy_m2);
  score.across_m.push_back(across_m);
  score.along_m.push_back(along_m);
  score.across_sigmas.push_back(across_sigmas);
  score.along_sigmas.push_back(along_sigmas);

  const bool nobodys = s.team == Team::unknown;
  const bool wrong = !nobodys && s.team != (t.red ? Team::first : Team::second);
  score.unknown_team += nobodys ? 1 : 0;
  score.wrong_team += wrong ? 1 : 0;
  const bool far_off = std::max(std::abs(across_sigmas), std::abs(along_sigmas)) > most_sigmas;
  if (!wrong && !nobodys && !far_off) return;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), ": %s at %.3f %.3f, %.1f mm across (%.1f sigmas), %.1f mm along (%.1f)",
                wrong     ? "the wrong team"
                : nobodys ? "no team"
                          : "far off",
                t.x_m, t.y_m, 1e3 * across_m, across_sigmas, 1e3 * along_m, along_sigmas);
  score.failures.push_back(what + text.data());
}

void add_stones(const FarScene& far, const FarPercept& seen, FarScore& score) {
  const std::vector<Pairing> pairs = paired(far.stones, seen.stones);
  for (std::size_t i = 0; i < far.stones.size(); ++i) {
    const BoardStone& t = far.stones[i];
    if (!in_sight(t)) continue;
    ++score.in_sight;
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [i](const Pairing& p) { return p.stone == i; });
    if (pair == pairs.end()) {
      ++score.missed;
      score.failures.push_back(far.scene.what + ": missed at " + std::to_string(t.x_m) + " " + std::to_string(t.y_m));
      continue;
    }
    const StoneSighting& s = seen.stones[pair->sighting];
    add_errors(far.scene.what, t, s, whole_covariance(seen, s), score);
  }
  for (std::size_t j = 0; j < seen.stones.size(); ++j) {
    if (std::any_of(pairs.begin(), pairs.end(), [j](const Pairing& p) { return p.sighting == j; })) continue;
    const StoneSighting& s = seen.stones[j];
    ++score.ghosts;
    score.failures.push_back(far.scene.what + ": ghost at " + std::to_string(s.x_m) + " " + std::to_string(s.y_m));
  }
}

}  // namespace

FarSetup far_setup_of(const CameraSetup& camera) {
  FarSetup setup;
  setup.camera = camera;
  return setup;
}

FarPlan far_plan_of(const FarScene& far) {
  FarPlan plan;
  plan.eMc = far.planned;
  return plan;
}

hogline::testing::FarMix crowded() { return {.most_stones = 8, .least_stones = 5}; }

hogline::testing::FarMix nobodys_stones() {
  return {.most_stones = 0, .least_stones = 0, .most_people = 6, .most_neighbours = 6, .most_logos = 4};
}

FarPercept look_far(const FarScene& far) {
  FarView view(far_setup_of(far.scene.setup));
  return view.look(render(far.scene), {}, far_plan_of(far));
}

double FarScore::rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double FarScore::mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

void add_look(const FarScene& far, const FarPercept& seen, FarScore& score) {
  if (!seen.ok) {
    ++score.refused;
    score.failures.push_back(far.scene.what + ": " + seen.reason);
    return;
  }
  add_tilt(far, seen, score);
  add_stones(far, seen, score);
}

FarScore score_far(std::uint64_t first, int count, const hogline::testing::FarMix& mix) {
  FarScore score;
  for (int i = 0; i < count; ++i) {
    const FarScene far = hogline::testing::random_far_scene(first + static_cast<std::uint64_t>(i), mix);
    add_look(far, look_far(far), score);
  }
  return score;
}

}  // namespace hogline::vision::testing
