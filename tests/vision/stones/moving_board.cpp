#include "tests/vision/stones/moving_board.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace hogline::vision::testing {
namespace {

constexpr double same_place_m = 0.12;
constexpr double least_in_sight = 0.5;
constexpr double deceleration_mps2 = 0.6;
constexpr double least_room_m = 0.25;
constexpr double clear_m = 0.30;

/// How far a stone can go before it touches another or leaves the sheet.
double room_of(const hogline::testing::RandomBoard& board, std::size_t which, double direction_rad) {
  const double half_width_m = 0.5 * board.scene.sheet_width_m - 0.15;
  const auto& from = board.stones[which];
  for (double m = 0.0; m < 2.5; m += 0.02) {
    const double x = from.x_m - m * std::sin(direction_rad), y = from.y_m + m * std::cos(direction_rad);
    bool clear = std::abs(x) < half_width_m && y > -2.0 && y < 6.2 &&
                 std::hypot(x - board.scene.body.x_m, y - board.scene.body.y_m) > 1.7;
    for (std::size_t i = 0; i < board.stones.size(); ++i) {
      clear = clear && (i == which || std::hypot(board.stones[i].x_m - x, board.stones[i].y_m - y) > clear_m);
    }
    if (!clear) return m;
  }
  return 2.5;
}

}  // namespace

MovingBoard::MovingBoard(std::uint64_t seed, const Happenings& what)
    : what_(what),
      board_(hogline::testing::random_board(seed, {.most_stones = 10, .most_people = 1})),
      renderer_(board_.scene.setup.intrinsics, board_.scene.setup.ice, board_.scene.rink, board_.scene.sensor, seed) {
  if (what_.struck_at < 0) return;
  for (std::size_t i = 0; i < board_.stones.size() && !struck_; ++i) {
    if (board_.stones[i].in_sight < 0.9) continue;
    for (int k = 0; k < 8; ++k) {
      const double direction = 0.25 * std::numbers::pi * static_cast<double>((k + seed) % 8);
      const double room = room_of(board_, i, direction);
      if (room < std::max(least_room_m, room_m_)) continue;
      struck_ = i;
      direction_rad_ = direction;
      room_m_ = room;
    }
  }
}

StonesSetup MovingBoard::setup() const {
  StonesSetup setup;
  setup.camera = board_.scene.setup;
  return setup;
}

Stamp MovingBoard::stamp(int k) const { return Stamp{from_seconds(1.0 + k / what_.rate_hz)}; }

double MovingBoard::way_m(double t_s) const {
  const double speed = std::min(what_.speed_mps, std::sqrt(2.0 * deceleration_mps2 * room_m_));
  const double t = std::clamp(t_s, 0.0, speed / deceleration_mps2);
  return speed * t - 0.5 * deceleration_mps2 * t * t;
}

hogline::testing::RandomBoard MovingBoard::at(int k, bool with_sight) const {
  hogline::testing::RandomBoard now = board_;
  const double t_s = k / what_.rate_hz;
  if (struck_) {
    const double way = way_m(t_s - what_.struck_at / what_.rate_hz);
    now.stones[*struck_].x_m -= way * std::sin(direction_rad_);
    now.stones[*struck_].y_m += way * std::cos(direction_rad_);
    now.scene.exposure.stones[*struck_].x_m = now.stones[*struck_].x_m;
    now.scene.exposure.stones[*struck_].y_m = now.stones[*struck_].y_m;
  }
  if (what_.walker) {
    hw::sim::PersonLook walker;
    walker.x_m = -2.0 + 1.3 * t_s;
    walker.y_m = 1.0 + static_cast<double>(board_.scene.seed % 4);
    walker.facing_rad = -0.5 * std::numbers::pi;
    walker.stride_m = 0.35 * std::sin(6.0 * t_s);
    now.scene.exposure.people.push_back(walker);
  }
  if (with_sight) hogline::testing::measure_visibility(now.scene, now.stones);
  return now;
}

cv::Mat MovingBoard::picture(int k) const {
  cv::Mat bgr;
  renderer_.render(at(k, false).scene.exposure, static_cast<std::uint64_t>(k), bgr);
  return bgr;
}

void SequenceScore::add(std::uint64_t seed, int k, const hogline::testing::RandomBoard& truth,
                        std::optional<std::size_t> struck_stone, const StonesPercept& seen) {
  ++looks;
  std::vector<bool> used(seen.stones.size(), false);
  const auto note = [&](const char* word, double x_m, double y_m, double share) {
    char text[128];
    std::snprintf(text, sizeof text, "board %d, picture %d: %s at (%.2f, %.2f), %.0f %% in sight",
                  static_cast<int>(seed), k, word, x_m, y_m, 100.0 * share);
    failures.emplace_back(text);
  };
  for (std::size_t j = 0; j < truth.stones.size(); ++j) {
    const auto& t = truth.stones[j];
    bool hit = false;
    double error_m = 0.0;
    for (std::size_t i = 0; i < used.size() && !hit; ++i) {
      error_m = std::hypot(seen.stones[i].x_m - t.x_m, seen.stones[i].y_m - t.y_m);
      if (used[i] || error_m > same_place_m) continue;
      used[i] = hit = true;
    }
    if (t.in_sight < least_in_sight) continue;
    ++stones;
    found += hit ? 1 : 0;
    if (hit) square_m2 += error_m * error_m;
    if (!hit) note("missed", t.x_m, t.y_m, t.in_sight);
    if (struck_stone != j) continue;
    ++struck;
    struck_found += hit ? 1 : 0;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) continue;
    ++ghosts;
    note("ghost", seen.stones[i].x_m, seen.stones[i].y_m, 0.0);
  }
}

double SequenceScore::rms_m() const { return found > 0 ? std::sqrt(square_m2 / found) : 0.0; }

std::string SequenceScore::words() const {
  char text[200];
  std::snprintf(text, sizeof text,
                "%d looks, %d stones in sight: %d found (%.2f %%), %d ghosts; of the struck one %d of %d; %.1f mm RMS",
                looks, stones, found, stones > 0 ? 100.0 * found / stones : 100.0, ghosts, struck_found, struck,
                1e3 * rms_m());
  return text;
}

}  // namespace hogline::vision::testing
