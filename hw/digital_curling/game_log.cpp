#include "hw/digital_curling/game_log.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace hogline::hw::digital_curling {

using nlohmann::ordered_json;

GameLog::GameLog(std::ostream& to, std::function<std::string()> date_time)
    : to_(to), date_time_(std::move(date_time)) {}

void GameLog::entry(const char* tag, const std::string& json) {
  ordered_json line{{"tag", tag}, {"id", next_id_++}, {"date_time", date_time_()}, {"thread", "0"}};
  line["log"] = ordered_json::parse(json);
  to_ << line.dump() << '\n' << std::flush;
}

void GameLog::begin(const GameIdentity& identity, const GameOffer& offer,
                    const std::array<std::string, servo::team_count>& names,
                    const std::array<std::array<int, 4>, servo::team_count>& player_orders) {
  const std::string is_ready = is_ready_message(offer, std::nullopt);
  const ordered_json config{{"game", ordered_json::parse(is_ready)["game"]}};
  entry("gam", dc_message(identity));
  entry("gam", ordered_json{{"cmd", "meta"}, {"meta", "spec"}, {"host_name", "hogline"}}.dump());
  entry("gam", ordered_json{{"cmd", "meta"}, {"meta", "config"}, {"config", config}, {"config_all", config}}.dump());
  for (const std::size_t side : {0u, 1u}) entry("gam", dc_ok_record(servo::team_of(side), names[side]));
  entry("gam", is_ready);
  for (const std::size_t side : {0u, 1u}) entry("gam", ready_ok_record(servo::team_of(side), player_orders[side]));
  entry("gam", new_game_message(names));
}

void GameLog::update(const servo::GameUpdate& update) { entry("gam", update_message(update, false)); }

void GameLog::move(Team team, const servo::GameMove& move) { entry("gam", move_record(team, move)); }

void GameLog::game_over() { entry("gam", game_over_message()); }

void GameLog::error(const std::string& what) { entry("err", ordered_json(what).dump()); }

}  // namespace hogline::hw::digital_curling
