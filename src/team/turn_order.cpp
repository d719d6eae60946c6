#include "src/team/turn_order.hpp"

namespace hogline {

TurnOrder order_of(const game::Turn& turn, const std::vector<StoneSighting>& standing,
                   std::optional<double> sheet_width_m, const servo::ThrowerSkill& skill, const servo::IceModel& ice) {
  TurnOrder result;
  result.names = names_of(standing, turn.board);
  servo::Board board = turn.board;
  for (std::size_t i = 0; i < result.names.size(); ++i) {
    const auto& name = result.names[i];
    if (!name) {
      result.remarks.push_back("before the throw the skip sees something that is none of the board's stones");
      continue;
    }
    board.stones[name->side][name->stone] = on_board(standing[i].x_m, standing[i].y_m, 0.0);
  }
  if (turn.decision.order) {
    result.order = *turn.decision.order;
    return result;
  }
  servo::Surroundings around{{}, sheet_width_m};
  for (const auto& side : board.stones)
    for (const auto& stone : side)
      if (stone) around.stones.push_back({stone->x_m, stone->y_m});
  result.mapped = map_shot(std::get<servo::HackShot>(turn.decision.move), around, skill, ice);
  result.order = result.mapped->order;
  if (!result.mapped->ok) result.refused = result.mapped->reason;
  return result;
}

}  // namespace hogline
