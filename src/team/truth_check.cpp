#include "src/team/truth_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hogline {
namespace {

constexpr double can_be_seen_m = 0.02;  // less is a measure: two stones of the near view, three sigmas each

bool same_stones(const servo::Board& a, const servo::Board& b) {
  for (std::size_t side : {0u, 1u})
    for (std::size_t i = 0; i < servo::stones_each; ++i)
      if (a.stones[side][i].has_value() != b.stones[side][i].has_value()) return false;
  return true;
}

double hog_margin_m(const servo::Board& lying) {
  double margin_m = 1e9;
  for (const auto& side : lying.stones) {
    for (const auto& stone : side) {
      if (!stone) continue;
      const double past_m = stone->y_m - servo::in_sheet::hog_y_m - servo::in_sheet::stone_radius_m;
      margin_m = std::min(margin_m, std::abs(past_m));
    }
  }
  return margin_m;
}

}  // namespace

TruthCheck::TruthCheck(const servo::GameSetting& setting, game::GameListener& next) : setting_(setting), next_(next) {}

void TruthCheck::stands(const servo::GameUpdate& update) {
  before_ = update.state;
  next_.stands(update);
}

void TruthCheck::thrown(const game::Turn& turn, const game::ThrowReport& report, const servo::Judged& judged) {
  ++figures_.throws;
  figures_.repeated += std::max(0, record_.attempts - 1);
  figures_.unfollowed += record_.followed && !record_.followed->ok ? 1 : 0;
  if (judged.end) ++figures_.ends;
  if (report.end == game::ThrowEnd::thrown) {
    compare(judged);
  } else {
    ++figures_.given_away;
  }
  next_.thrown(turn, report, judged);
}

// The same rules, on where the stones lay and lie.
void TruthCheck::compare(const servo::Judged& seen) {
  servo::GameState before = before_;
  before.board = record_.true_before;
  const servo::Judged truth = judge(before, record_.truth.stones, setting_);
  if (!truth.ok) return disagree("the truth can not be: " + truth.reason, 1.0);
  places(seen.board, truth.board);
  figures_.collisions += record_.truth.stones.struck ? 1 : 0;
  figures_.struck_wrong += record_.truth.stones.struck != record_.report.seen.struck ? 1 : 0;
  const double lying_m = std::min(record_.truth.margin_m, hog_margin_m(record_.truth.stones.lying));
  if (seen.free_guard_zone_foul != truth.free_guard_zone_foul) disagree("free guard zone", lying_m);
  if (!same_stones(seen.board, truth.board)) disagree("which stones are in play", lying_m);
  if (!truth.end) return;
  const double score_m = servo::score_margin_m(truth.board);
  figures_.measures += score_m < can_be_seen_m ? 1 : 0;
  if (*seen.end == *truth.end) return;
  disagree(fmt::format("score {}:{} as seen, {}:{} in truth", (*seen.end)[0], (*seen.end)[1], (*truth.end)[0],
                       (*truth.end)[1]),
           std::min(score_m, lying_m));
}

void TruthCheck::places(const servo::Board& seen, const servo::Board& truth) {
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto &s = seen.stones[side][i], &t = truth.stones[side][i];
      if (!s || !t) continue;
      const double off_m = std::hypot(s->x_m - t->x_m, s->y_m - t->y_m);
      figures_.square_m2 += off_m * off_m;
      figures_.worst_m = std::max(figures_.worst_m, off_m);
      ++figures_.places;
    }
  }
}

void TruthCheck::disagree(const std::string& what, double margin_m) {
  figures_.disagreements.push_back({before_.end, before_.shot, what, margin_m, margin_m < can_be_seen_m});
}

}  // namespace hogline
