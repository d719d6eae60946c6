#include "src/faults/strike_journal.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "src/config/config_error.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::faults {
namespace {

using nlohmann::ordered_json;
using servo::ThrowerState;

constexpr std::array states{ThrowerState::unfold,  ThrowerState::rehearse, ThrowerState::measure,
                            ThrowerState::align,   ThrowerState::fold,     ThrowerState::run,
                            ThrowerState::release, ThrowerState::brake,    ThrowerState::stopped};

ordered_json head_of(const std::vector<const Case*>& faults, std::uint64_t seed, const std::string& program) {
  ordered_json names = ordered_json::array();
  for (const Case* fault : faults) names.push_back(fault->name + ": " + fault->injected);
  return {{"seed", seed}, {"program", program}, {"faults", std::move(names)}};
}

std::string line_of(const ordered_json& object) {
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

template <typename Range>
auto named(const Range& range, const std::string& word) {
  const auto found = std::ranges::find_if(range, [&](auto value) { return word == to_string(value); });
  if (found == range.end()) throw std::runtime_error("an unknown word");
  return *found;
}

}  // namespace

StrikeJournal::StrikeJournal(std::string path, const std::vector<const Case*>& faults, std::uint64_t seed,
                             const std::string& program)
    : path_(std::move(path)), faults_(faults), seed_(seed) {
  const std::string head = line_of(head_of(faults, seed, program));
  if (std::filesystem::exists(path_)) {
    take_up(head);
    return;
  }
  std::ofstream stream(path_, std::ios::binary);
  stream << head;
  if (!stream.flush()) throw std::runtime_error(path_ + ": can not be written");
}

void StrikeJournal::take_up(const std::string& head) {
  std::string text = config::read_file(path_);
  text.resize(text.rfind('\n') + 1);  // what follows the last end of a line was not finished
  if (!text.starts_with(head)) {
    throw config::ConfigError("command line", 0, "--out", path_,
                              "holds other faults, another seed or another build's; name another folder");
  }
  try {
    for (std::size_t begin = head.size(); begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      const auto row = nlohmann::json::parse(text.substr(begin, end - begin));
      const StrikePlace place{row.at("fault").get<std::size_t>(), row.at("number").get<int>()};
      RandomStrike strike = drawn_strike(faults_, place, seed_);
      strike.struck.state = named(states, row.at("state").get<std::string>());
      strike.struck.room_m = row.at("room_m").get<double>();
      strike.struck.finding.speed_mps = row.at("speed_mps").get<double>();
      strike.struck.finding.log = row.at("log").get<std::string>();
      strike.needed_m = row.at("needed_m").get<double>();
      strike.ending = named(all_endings(), row.at("ending").get<std::string>());
      known_[place] = std::move(strike);
      begin = end + 1;
    }
  } catch (const std::exception&) {
    throw config::ConfigError(path_, 0, "", "", "is no journal of strikes; was the file edited?");
  }
  std::filesystem::resize_file(path_, text.size());
}

void StrikeJournal::append(const StrikePlace& place, const RandomStrike& strike) {
  std::ofstream stream(path_, std::ios::binary | std::ios::app);
  stream << line_of({{"fault", place.fault},
                     {"number", place.number},
                     {"state", servo::to_string(strike.struck.state)},
                     {"speed_mps", strike.struck.finding.speed_mps},
                     {"room_m", strike.struck.room_m},
                     {"needed_m", strike.needed_m},
                     {"ending", to_string(strike.ending)},
                     {"log", strike.struck.finding.log}});
  if (!stream.flush()) throw std::runtime_error(path_ + ": can not be written");
}

}  // namespace hogline::faults
