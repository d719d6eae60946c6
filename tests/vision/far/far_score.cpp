#include "tests/vision/far/far_score.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision::testing {
namespace {

using hogline::testing::BoardStone;
using hogline::testing::FarScene;

constexpr double same_across_m = 0.2;
constexpr double same_along_m = 0.6;

bool in_sight(const BoardStone& s) { return s.handle_seen >= 0.5 && s.handle_seen + s.body_seen >= 1.6; }

void add_tilt(const FarScene& far, const FarPercept& seen, FarScore& score) {
  const Eigen::AngleAxisd off(from_row_major(seen.eMc).linear() * far.scene.eMc.linear().transpose());
  const double tilt = -(off.angle() * off.axis()).x();
  score.tilt_rad.push_back(tilt);
  score.tilt_sigmas.push_back(tilt / seen.correction.tilt_sigma_rad);
}

// Each stone of the truth takes the nearest sighting, the visible ones first.
void add_stones(const FarScene& far, const FarPercept& seen, FarScore& score) {
  std::vector<StoneSighting> left = seen.stones;
  std::vector<BoardStone> truth = far.stones;
  std::stable_sort(truth.begin(), truth.end(),
                   [](const BoardStone& a, const BoardStone& b) { return in_sight(a) && !in_sight(b); });
  for (const BoardStone& t : truth) {
    const auto distance = [&t](const StoneSighting& s) {
      return std::hypot((s.x_m - t.x_m) / same_across_m, (s.y_m - t.y_m) / same_along_m);
    };
    const auto best = std::min_element(left.begin(), left.end(), [&](const StoneSighting& a, const StoneSighting& b) {
      return distance(a) < distance(b);
    });
    const bool found = best != left.end() && distance(*best) < 1.0;
    if (in_sight(t)) ++score.in_sight;
    if (!found) {
      if (!in_sight(t)) continue;
      ++score.missed;
      score.failures.push_back(far.scene.what + ": missed at " + std::to_string(t.x_m) + " " + std::to_string(t.y_m));
      continue;
    }
    const StoneSighting s = *best;
    left.erase(best);
    if (!in_sight(t)) continue;
    const PlaceCovariance whole = whole_covariance(seen, s);
    score.across_m.push_back(s.x_m - t.x_m);
    score.along_m.push_back(s.y_m - t.y_m);
    score.across_sigmas.push_back((s.x_m - t.x_m) / std::sqrt(whole.xx_m2));
    score.along_sigmas.push_back((s.y_m - t.y_m) / std::sqrt(whole.yy_m2));
    score.wrong_team += s.team == (t.red ? Team::first : Team::second) ? 0 : 1;
  }
  score.ghosts += static_cast<int>(left.size());
  for (const StoneSighting& s : left) {
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

FarScore score_far(std::uint64_t first, int count, const hogline::testing::FarMix& mix) {
  FarScore score;
  for (int i = 0; i < count; ++i) {
    const FarScene far = hogline::testing::random_far_scene(first + static_cast<std::uint64_t>(i), mix);
    const FarPercept seen = look_far(far);
    if (!seen.ok) {
      ++score.refused;
      score.failures.push_back(far.scene.what + ": " + seen.reason);
      continue;
    }
    add_tilt(far, seen, score);
    add_stones(far, seen, score);
  }
  return score;
}

}  // namespace hogline::vision::testing
