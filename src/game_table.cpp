#include "src/game_table.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "hw/clock.hpp"
#include "src/config/config_error.hpp"
#include "src/game/built_in_strategist.hpp"
#include "src/game/practice.hpp"

namespace hogline {
namespace {

using hw::DigitalCurlingStrategist;
using hw::digital_curling::GameIdentity;
using hw::digital_curling::GameOffer;

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

GameOffer offer_of(const TableOptions& options, double sheet_width_m, const servo::ThrowerSkill& skill) {
  GameOffer offer;
  offer.setting.ends = options.ends;
  offer.setting.sheet_width_m = sheet_width_m;
  offer.setting.thinking.fill(from_seconds(options.thinking_s));
  offer.setting.extra_thinking.fill(from_seconds(options.extra_thinking_s));
  offer.players.fill(player(skill));
  return offer;
}

/// Where there is no folder, no file either.
std::ofstream opened(const std::filesystem::path& folder, const char* name) {
  if (folder.empty()) return {};
  const std::filesystem::path path = folder / name;
  std::ofstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("{}: can not be written; check the folder", path.string()));
  return stream;
}

std::unique_ptr<DigitalCurlingStrategist> opened_seat(const hw::DigitalCurlingConfig& config, const char* option) {
  try {
    return std::make_unique<DigitalCurlingStrategist>(config);
  } catch (const std::system_error& error) {
    const std::string advice = error.code() == std::errc::address_in_use
                                   ? "end the program that has this port, or name another one; dc:0 takes any"
                               : error.code() == std::errc::address_not_available
                                   ? "--address must be one of this machine's own (ip address lists them)"
                                   : "name another port, or another --address";
    throw std::runtime_error(fmt::format("{} dc:{}: no client can be waited for at {}:{}: {}; {}", option, config.port,
                                         config.address, config.port, error.code().message(), advice));
  }
}

}  // namespace

void check_seats(const TableOptions& options) {
  const auto port = port_of(options.second);
  if (port && *port != 0 && port_of(options.first) == port)
    throw config::ConfigError("command line", 0, "--team0 and --team1", options.second,
                              "are one port: give each team's client its own, or dc:0 for any that is free");
}

std::string known_strategist(const std::string& text) {
  if (text == "built-in" || port_of(text)) return {};
  return "'" + text + "' is no strategist: built-in, or dc:PORT with a port from 0 (any that is free) to 65535";
}

GameTable::GameTable(const TableOptions& options, double sheet_width_m, const servo::ThrowerSkill& skill,
                     std::function<servo::IceModel()> ice)
    : out_(options.out),
      identity_{game_id(), date_time()},
      offer_(offer_of(options, sheet_width_m, skill)),
      lines_(opened(out_, "game.jsonl")),
      record_(opened(out_, "game.dcl2")),
      log_(record_, date_time),
      journal_(
          [this, print = options.print](const std::string& line) {
            lines_ << line << '\n' << std::flush;
            if (!print) return;
            fmt::print("{}\n", line);
            std::fflush(stdout);
          },
          log_, identity_, offer_, [this] { return player_orders(); }) {
  for (const std::size_t side : {0u, 1u}) seat(side, options, skill, ice);
}

void GameTable::seat(std::size_t side, const TableOptions& options, const servo::ThrowerSkill& skill,
                     const std::function<servo::IceModel()>& ice) {
  const Team team = servo::team_of(side);
  const auto port = port_of(side == 0 ? options.first : options.second);
  if (!port) {
    strategists_[side] = std::make_unique<game::BuiltInStrategist>(team, skill, ice);
    return;
  }
  hw::DigitalCurlingConfig config{.address = options.address, .port = *port, .session = {}};
  config.session.team = team;
  config.session.identity = identity_;
  config.session.offer = offer_;
  config.session.connect_deadline = from_seconds(options.connect_s);
  auto client = opened_seat(config, side == 0 ? "--team0" : "--team1");
  fmt::print(stderr, "{} waits for its client at {}:{}, {:.0f} s at most\n", hw::digital_curling::team_name(team),
             options.address, client->port(), options.connect_s);
  clients_[side] = client.get();
  strategists_[side] = std::move(client);
}

std::array<hw::Strategist*, servo::team_count> GameTable::strategists() {
  return {strategists_[0].get(), strategists_[1].get()};
}

game::GameJournal::PlayerOrders GameTable::player_orders() const {
  game::GameJournal::PlayerOrders orders;
  for (const std::size_t side : {0u, 1u})
    orders[side] = clients_[side] ? clients_[side]->player_order() : std::array{0, 1, 2, 3};
  return orders;
}

std::string GameTable::practise(const TableOptions& options, const servo::ThrowerSkill& skill,
                                const std::function<servo::IceModel()>& ice, game::StoneThrower& thrower) {
  const hw::SteadyClock clock;
  game::Practice practice(
      options.practice, skill, ice, strategists(), thrower,
      [this](int draw, const game::Turn&, const game::ThrowReport& report) { journal_.practised(draw, report); });
  while (!practice.over()) practice.step(clock.now());
  if (!practice.failure().empty()) journal_.stopped(practice.failure());
  return practice.failure();
}

void GameTable::play(game::Referee& referee, const std::function<bool()>& enough) {
  using game::RefereePhase;
  const hw::SteadyClock clock;
  const bool foreign = clients_[0] || clients_[1];
  while (referee.phase() != RefereePhase::over && referee.phase() != RefereePhase::stopped) {
    if (enough && enough()) return;
    referee.step(clock.now());
    if (foreign && referee.phase() != RefereePhase::throwing) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void GameTable::close() {
  if (out_.empty()) return;
  lines_.close();
  record_.close();
  if (!lines_ || !record_) throw std::runtime_error(out_ + ": can not be written; check the disk's space");
}

}  // namespace hogline
