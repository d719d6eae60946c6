#include "src/game/game_journal.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace hogline::game {
namespace {

using nlohmann::ordered_json;

constexpr double most_margin_m = 100.0;  // nothing lies near enough to count
constexpr double decided_sigmas = 2.0;
using namespace servo;
using hw::digital_curling::team_name;

ordered_json order_json(const ShotOrder& order) {
  return {{"speed_mps", order.speed_mps},
          {"heading_rad", order.heading_rad},
          {"curl", order.curl == Curl::clockwise ? "cw" : "ccw"},
          {"spin_radps", order.spin_radps}};
}

ordered_json outcome_json(const IntendedOutcome& outcome) {
  constexpr std::array<const char*, 3> names{"rest", "touch", "leave"};
  return {{"what", names[static_cast<std::size_t>(outcome.intent)]},
          {"x_m", outcome.place.x_m},
          {"y_m", outcome.place.y_m},
          {"speed_mps", outcome.speed_mps},
          {"heading_rad", outcome.heading_rad}};
}

ordered_json board_json(const Board& board) {
  ordered_json stones = ordered_json::array();
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      const auto& stone = board.stones[side][i];
      if (stone)
        stones.push_back({{"team", team_name(team_of(side))}, {"stone", i}, {"x_m", stone->x_m}, {"y_m", stone->y_m}});
    }
  }
  return stones;
}

const char* name_of(OutOfPlay why) {
  constexpr std::array<const char*, 3> names{"sideline", "through", "hogged"};
  return names[static_cast<std::size_t>(why)];
}

const char* name_of(ThrowEnd end) {
  constexpr std::array<const char*, 3> names{"thrown", "refused", "failed"};
  return names[static_cast<std::size_t>(end)];
}

ordered_json removed_json(const std::vector<Removal>& removed) {
  ordered_json all = ordered_json::array();
  for (const Removal& r : removed)
    all.push_back({{"team", team_name(r.team)}, {"stone", r.stone}, {"why", name_of(r.why)}});
  return all;
}

ordered_json result_json(const GameResult& result) {
  constexpr std::array<const char*, 4> reasons{"score", "concede", "time_limit", "draw"};
  return {{"winner", result.winner ? ordered_json(team_name(*result.winner)) : ordered_json(nullptr)},
          {"reason", reasons[static_cast<std::size_t>(result.reason)]}};
}

}  // namespace

GameJournal::GameJournal(std::function<void(const std::string&)> line, hw::digital_curling::GameLog& log,
                         const hw::digital_curling::GameIdentity& identity, const hw::digital_curling::GameOffer& offer,
                         std::function<PlayerOrders()> player_orders)
    : line_(std::move(line)), log_(log), identity_(identity), offer_(offer), player_orders_(std::move(player_orders)) {}

void GameJournal::begun(const std::array<std::string, team_count>& names) {
  log_.begin(identity_, offer_, names, player_orders_());
  line_(ordered_json{{"event", "begin"}, {"teams", names}, {"ends", offer_.setting.ends}}.dump());
}

void GameJournal::stands(const GameUpdate& update) {
  log_.update(update);
  end_ = update.state.end;
  shot_ = update.state.shot;
  if (!update.state.result) return;
  log_.game_over();
  line_(ordered_json{{"event", "over"},
                     {"score", {total(update.state, Team::first), total(update.state, Team::second)}},
                     {"result", result_json(*update.state.result)}}
            .dump());
}

// The record of Digital Curling's programs knows no practice.
void GameJournal::practised(int draw, const ThrowReport& report) {
  ordered_json event{{"event", "practice"}, {"draw", draw}, {"outcome", name_of(report.end)}};
  if (report.end == ThrowEnd::thrown)
    event["order"] = order_json(report.order);
  else
    event["reason"] = report.reason;
  event["lying"] = board_json(report.seen.lying);
  line_(event.dump());
}

void GameJournal::decided(const Turn& turn) { log_.move(turn.team, turn.decision.move); }

void GameJournal::thrown(const Turn& turn, const ThrowReport& report, const Judged& judged) {
  ordered_json event{{"event", "throw"},
                     {"end", end_},
                     {"shot", shot_},
                     {"team", team_name(turn.team)},
                     {"thought_s", seconds(turn.decision.thought)},
                     {"outcome", name_of(report.end)}};
  if (!turn.decision.plan.empty()) event["plan"] = turn.decision.plan;
  if (report.mapped) {
    event["intended"] = outcome_json(report.mapped->intended);
    event["sigma_m"] = report.mapped->sigma_m;
  }
  if (report.end == ThrowEnd::thrown)
    event["order"] = order_json(report.order);
  else
    event["reason"] = report.reason;
  event["free_guard_zone_foul"] = judged.free_guard_zone_foul;
  event["removed"] = removed_json(judged.removed);
  event["board"] = board_json(judged.board);
  if (judged.end) {
    const double margin_m = score_margin_m(judged.board);
    event["end_score"] = *judged.end;
    event["margin_m"] = margin_m > most_margin_m ? ordered_json(nullptr) : ordered_json(margin_m);
    event["measure"] = report.seen_sigma_m > 0.0 && margin_m < decided_sigmas * std::sqrt(2.0) * report.seen_sigma_m;
  }
  line_(event.dump());
}

void GameJournal::stopped(const std::string& reason) {
  log_.error(reason);
  line_(ordered_json{{"event", "stopped"}, {"reason", reason}}.dump());
}

}  // namespace hogline::game
