#include "src/game_command.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <thread>

#include "hw/clock.hpp"
#include "hw/digital_curling/digital_curling_strategist.hpp"
#include "src/exit_status.hpp"
#include "src/game/built_in_strategist.hpp"
#include "src/game/game_journal.hpp"
#include "src/game/simulated_throws.hpp"
#include "src/output/output_file.hpp"

namespace hogline {
namespace {

using hw::DigitalCurlingStrategist;
using hw::digital_curling::GameIdentity;
using hw::digital_curling::GameOffer;

/// The practice robot's stone: where it is let go, and how truly, by the campaigns of doc/performance.md.
servo::ThrowerSkill practice_skill() {
  return {.release = {0.0, 9.159},
          .max_speed_mps = 3.4,
          .spin_radps = 1.5,
          .speed_sigma_mps = 0.006,
          .heading_sigma_rad = 0.03 * std::numbers::pi / 180.0};
}

std::string date_time() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", now);
}

/// A UUID of version 4.
std::string game_id() {
  std::random_device random;
  const auto word = [&] { return static_cast<std::uint32_t>(random()); };
  return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:08x}{:04x}", word(), word() & 0xffff, word() & 0xfff,
                     0x8000 | (word() & 0x3fff), word(), word() & 0xffff);
}

std::optional<int> port_of(const std::string& text) {
  int port = -1;
  if (!text.starts_with("dc:")) return std::nullopt;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + 3, end, port);
  if (error != std::errc() || rest != end || port < 0 || port > 65535) return std::nullopt;
  return port;
}

/// What a client may count on at the hack: a stone that slides from there is slower by the time it is let go.
hw::digital_curling::PlayerSkill player(const servo::ThrowerSkill& skill) {
  const servo::SlidingStone let_go{0.0, skill.release.y_m, 0.0, skill.max_speed_mps, 0.0};
  servo::SlidingStone back = let_go;
  while (back.y_m > 0.0) back = servo::slide(back, {}, -0.01).stone;
  return {servo::speed_mps(back), skill.speed_sigma_mps, skill.heading_sigma_rad};
}

GameOffer offer_of(const GameOptions& options, const game::SimulatedSheet& sheet, const servo::ThrowerSkill& skill) {
  GameOffer offer;
  offer.setting.ends = options.ends;
  offer.setting.sheet_width_m = sheet.width_m;
  offer.setting.thinking.fill(from_seconds(options.thinking_s));
  offer.setting.extra_thinking.fill(from_seconds(options.extra_thinking_s));
  offer.players.fill(player(skill));
  return offer;
}

/// The two strategists, and what the log must know of them.
struct Teams {
  std::array<std::unique_ptr<hw::Strategist>, servo::team_count> strategists;
  std::array<const DigitalCurlingStrategist*, servo::team_count> clients{};

  std::array<hw::Strategist*, servo::team_count> both() { return {strategists[0].get(), strategists[1].get()}; }
  game::GameJournal::PlayerOrders player_orders() const {
    game::GameJournal::PlayerOrders orders;
    for (const std::size_t side : {0u, 1u})
      orders[side] = clients[side] ? clients[side]->player_order() : std::array{0, 1, 2, 3};
    return orders;
  }
};

Teams teams_of(const GameOptions& options, const GameIdentity& identity, const GameOffer& offer,
               const servo::ThrowerSkill& skill, const game::SimulatedThrows& throws) {
  Teams teams;
  const std::array<std::string, servo::team_count> wanted{options.first, options.second};
  for (const std::size_t side : {0u, 1u}) {
    const Team team = servo::team_of(side);
    const auto port = port_of(wanted[side]);
    if (!port) {
      teams.strategists[side] =
          std::make_unique<game::BuiltInStrategist>(team, skill, [&throws] { return throws.ice(); });
      continue;
    }
    hw::DigitalCurlingConfig config{.address = options.address, .port = *port, .session = {}};
    config.session.team = team;
    config.session.identity = identity;
    config.session.offer = offer;
    config.session.connect_deadline = from_seconds(options.connect_s);
    auto client = std::make_unique<DigitalCurlingStrategist>(config);
    fmt::print(stderr, "{} waits for its client at {}:{}\n", hw::digital_curling::team_name(team), options.address,
               client->port());
    teams.clients[side] = client.get();
    teams.strategists[side] = std::move(client);
  }
  return teams;
}

std::ofstream opened(const std::filesystem::path& path) {
  std::ofstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("{}: can not be written; check the folder", path.string()));
  return stream;
}

void print_end(const game::Referee& referee) {
  const auto& state = referee.state();
  fmt::print(stderr, "{} : {}", total(state, Team::first), total(state, Team::second));
  if (referee.phase() == game::RefereePhase::stopped)
    fmt::print(stderr, ", stopped: {}\n", referee.reason());
  else
    fmt::print(stderr, " after {} ends{}{}\n", state.end, referee.reason().empty() ? "" : ", ", referee.reason());
}

}  // namespace

std::string known_strategist(const std::string& text) {
  if (text == "built-in" || port_of(text)) return {};
  return "'" + text + "' is no strategist: built-in, or dc:PORT with a port from 0 (any that is free) to 65535";
}

int run_game(const GameOptions& options) {
  check_folder("--out", options.out);
  const servo::ThrowerSkill skill = practice_skill();
  const game::SimulatedSheet sheet = game::any_sheet(options.seed);
  const GameIdentity identity{game_id(), date_time()};
  const GameOffer offer = offer_of(options, sheet, skill);
  game::SimulatedThrows throws(sheet, skill, servo::IceModel({}), options.seed);
  Teams teams = teams_of(options, identity, offer, skill, throws);

  std::ofstream lines = opened(std::filesystem::path(options.out) / "game.jsonl");
  std::ofstream record = opened(std::filesystem::path(options.out) / "game.dcl2");
  hw::digital_curling::GameLog log(record, date_time);
  const auto write = [&lines](const std::string& line) {
    lines << line << '\n' << std::flush;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  game::GameJournal journal(write, log, identity, offer, [&teams] { return teams.player_orders(); });
  game::Referee referee(offer.setting, teams.both(), throws, journal);

  const hw::SteadyClock clock;
  const bool foreign = teams.clients[0] || teams.clients[1];
  while (referee.phase() != game::RefereePhase::over && referee.phase() != game::RefereePhase::stopped) {
    referee.step(clock.now());
    if (foreign) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  print_end(referee);
  lines.close();
  record.close();
  if (!lines || !record) throw std::runtime_error(options.out + ": can not be written; is the disk full?");
  return referee.phase() == game::RefereePhase::over ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
