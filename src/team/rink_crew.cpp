#include "src/team/rink_crew.hpp"

#include <algorithm>
#include <cmath>

#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

constexpr double moved_m = 0.1;  // more than any error of the skip's, less than a stone

servo::SlidingStone in_sheet(const hw::sim::StoneTruth& s) {
  return {-s.x_m, servo::far_tee_in_sheet_m - s.y_m, -s.vx_mps, -s.vy_mps, s.spin_radps};
}

}  // namespace

RinkCrew::RinkCrew(hw::sim::TeamRink& rink, double sheet_width_m, double stone_radius_m)
    : rink_(rink), half_width_m_(0.5 * sheet_width_m), radius_m_(stone_radius_m) {}

void RinkCrew::lay(const servo::Board& board) {
  rink_.take_all_off();
  names_.clear();
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto& stone = board.stones[side][i];
      if (!stone) continue;
      const servo::Place at = in_skip_frame(*stone);
      rink_.lay(
          {.motion = {.x_m = at.x_m, .y_m = at.y_m, .handle_rad = stone->angle_rad}, .team = static_cast<int>(side)});
      names_.emplace_back(StoneName{side, i});
    }
  }
}

void RinkCrew::prepare(const servo::Board& board, const StoneName& next) {
  next_ = next;
  for (std::size_t i = 0; i < names_.size(); ++i) tidy(i, board);
  if (board == servo::Board{}) {
    rink_.take_all_off();
    names_.clear();
  }
  rink_.put_back(static_cast<int>(next.side));
  margins_.assign(names_.size(), {});
  before_.clear();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const hw::sim::FieldStone& stone = rink_.field().stones()[i];
    if (!stone.taken_off) before_[i] = {stone.motion.x_m, stone.motion.y_m};
  }
}

// The board is what the skip saw: a stone that was not touched lies a few millimetres beside it.
void RinkCrew::tidy(std::size_t number, const servo::Board& board) {
  if (!names_[number]) return;
  const hw::sim::FieldStone& stone = rink_.field().stones()[number];
  const auto& wanted = board.stones[names_[number]->side][names_[number]->stone];
  if (!wanted) {
    rink_.take_off(number);
    names_[number].reset();
    return;
  }
  const servo::Place at = in_skip_frame(*wanted);
  const auto off = [&](const servo::Place& p) { return std::hypot(p.x_m - at.x_m, p.y_m - at.y_m); };
  if (!stone.taken_off && off({stone.motion.x_m, stone.motion.y_m}) < moved_m) return;
  const auto before = before_.find(number);
  const servo::Place& back = before != before_.end() && off(before->second) < moved_m ? before->second : at;
  rink_.put(number, back.x_m, back.y_m);
}

void RinkCrew::watch() {
  const auto& stones = rink_.field().stones();
  if (names_.size() < stones.size()) {
    names_.push_back(next_);
    let_go_ = in_sheet(stones.back().motion);
  }
  margins_.resize(stones.size());
  for (std::size_t i = 0; i < stones.size(); ++i) {
    Margins& m = margins_[i];
    if (stones[i].taken_off || m.out()) continue;
    m.side_m = std::min(m.side_m, half_width_m_ - std::abs(stones[i].motion.x_m) - radius_m_);
    m.back_m = std::min(m.back_m, stones[i].motion.y_m + radius_m_ + servo::back_line_m);
  }
}

servo::Board RinkCrew::lying() const {
  servo::Board board;
  const auto& stones = rink_.field().stones();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!names_[i] || stones[i].taken_off || margins_[i].out()) continue;
    const hw::sim::StoneTruth& s = stones[i].motion;
    board.stones[names_[i]->side][names_[i]->stone] = on_board(s.x_m, s.y_m, s.handle_rad);
  }
  return board;
}

TrueThrow RinkCrew::truth() const {
  TrueThrow truth;
  truth.released = stone_is_gone();
  truth.let_go = let_go_;
  truth.stones.lying = lying();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i])
      truth.margin_m = std::min({truth.margin_m, std::abs(margins_[i].side_m), std::abs(margins_[i].back_m)});
  }
  const auto thrown = rink_.thrown();
  truth.stones.struck = thrown && std::ranges::any_of(rink_.field().contacts(), [&](const auto& c) {
                          const int number = static_cast<int>(*thrown);
                          return c.striker == number || c.struck == number;
                        });
  return truth;
}

}  // namespace hogline
