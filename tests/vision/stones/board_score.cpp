#include "tests/vision/stones/board_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

namespace hogline::vision::testing {
namespace {

constexpr double same_place_m = 0.12;
constexpr double hidden = 0.10;

bool can_be_seen(const hogline::testing::BoardStone& s) { return s.in_sight >= least_in_sight; }

std::string line(std::uint64_t seed, const char* what, double x_m, double y_m, const std::string& why) {
  char text[256];
  std::snprintf(text, sizeof text, "board %llu: %s at (%.2f, %.2f) %s", static_cast<unsigned long long>(seed), what,
                x_m, y_m, why.c_str());
  return text;
}

std::string seen_of(const hogline::testing::BoardStone& s) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.0f %% in sight; handle %.0f %%, body %.0f %%): ", 100.0 * s.in_sight,
                100.0 * s.handle_seen, 100.0 * s.body_seen);
  return text;
}

std::string doubt_near(const StonesSketch& sketch, double x_m, double y_m) {
  std::string last = "no votes";
  for (const auto& c : sketch.candidates) {
    if (std::hypot(c.votes.place.x() - x_m, c.votes.place.y() - y_m) < same_place_m) last = c.doubt;
  }
  return last;
}

double in_sigmas(const StoneSighting& s, double dx_m, double dy_m) {
  const PlaceCovariance& c = s.covariance;
  const double determinant = c.xx_m2 * c.yy_m2 - c.xy_m2 * c.xy_m2;
  const double square =
      (c.yy_m2 * dx_m * dx_m - 2.0 * c.xy_m2 * dx_m * dy_m + c.xx_m2 * dy_m * dy_m) / std::max(1e-18, determinant);
  return std::sqrt(0.5 * square);
}

void score(std::uint64_t seed, BoardScore& total) {
  const hogline::testing::RandomBoard board = hogline::testing::random_board(seed);
  const cv::Mat picture = hogline::testing::render(board.scene);
  StonesSetup setup;
  setup.camera = board.scene.setup;
  StoneFinder finder(setup);
  StonesSketch sketch;
  const StonesPercept seen = finder.find(picture, {}, board.scene.eMc, board.scene.sheet_width_m, &sketch);
  ++total.boards;
  std::vector<bool> used(seen.stones.size(), false);
  for (const auto& truth : board.stones) {
    const bool wanted = can_be_seen(truth);
    const bool between = !wanted && truth.in_sight >= hidden;
    total.stones += wanted ? 1 : 0;
    total.between += between ? 1 : 0;
    total.hidden += !wanted && !between ? 1 : 0;
    bool hit = false;
    for (std::size_t i = 0; i < seen.stones.size() && !hit; ++i) {
      const StoneSighting& s = seen.stones[i];
      const double error = std::hypot(s.x_m - truth.x_m, s.y_m - truth.y_m);
      if (used[i] || error > same_place_m) continue;
      used[i] = hit = true;
      total.between_found += between ? 1 : 0;
      if (!wanted) break;
      ++total.found;
      total.errors_m.push_back(error);
      total.in_sigmas.push_back(in_sigmas(s, s.x_m - truth.x_m, s.y_m - truth.y_m));
      if (std::hypot(truth.x_m, truth.y_m) < 2.0) total.house_errors_m.push_back(error);
      if (s.team == Team::unknown) ++total.unknown_team;
      if (s.team != Team::unknown && (s.team == Team::first) != truth.red) {
        ++total.wrong_team;
        total.failures.push_back(line(seed, "wrong team", truth.x_m, truth.y_m, ""));
      }
    }
    if (wanted && !hit) {
      total.failures.push_back(
          line(seed, "missed", truth.x_m, truth.y_m, seen_of(truth) + doubt_near(sketch, truth.x_m, truth.y_m)));
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) continue;
    ++total.ghosts;
    total.failures.push_back(line(seed, "ghost", seen.stones[i].x_m, seen.stones[i].y_m, ""));
  }
}

}  // namespace

double BoardScore::rms(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return v.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(v.size()));
}

BoardScore score_boards(std::uint64_t first, int count) {
  BoardScore total;
  for (int i = 0; i < count; ++i) score(first + static_cast<std::uint64_t>(i), total);
  return total;
}

}  // namespace hogline::vision::testing
