// Every fault of the table, at random moments of random throws.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "src/faults/fault_trial.hpp"

namespace hogline::faults {

/// How a throw with a fault ended.
enum class Ending {
  thrown,          ///< the stone was let go in its window, and the robot stands
  kept,            ///< the robot stands before the line with the stone
  too_late,        ///< it stands with the stone in the line, which no brake could have prevented
  set_down,        ///< it stands in the hack, and the stone beside its jaws: it was being tried on
  lost,            ///< the fault itself took the stone from the jaws; the robot stands
  carried_over,    ///< it stands with the stone in the line, though brakes could have prevented that
  outside_window,  ///< the stone was let go elsewhere
  not_stopped,
};
const char* to_string(Ending ending);
/// In the order of the table's columns.
std::span<const Ending> all_endings();

struct RandomStrike {
  const Case* fault = nullptr;
  int number = 0;  ///< of this fault, from 0
  Moment moment;
  Struck struck;
  double needed_m = 0.0;  ///< the way from the strike to standstill with the rig's brakes
  Ending ending = Ending::kept;
};

/// Those of the table that can strike at any moment, each once: not those that are there from power-on, nor those that
/// belong to the trial of the jaws, nor those that strike while the robot brakes for another.
std::vector<const Case*> faults_of_any_moment();

/// Which fault of a list, and which strike of it.
struct StrikePlace {
  std::size_t fault = 0;
  int number = 0;
  auto operator<=>(const StrikePlace&) const = default;
};
using KnownStrikes = std::map<StrikePlace, RandomStrike>;

/// What is drawn, and not yet carried out. Throws std::out_of_range where there is no such fault.
RandomStrike drawn_strike(const std::vector<const Case*>& faults, const StrikePlace& place, std::uint64_t seed);

/// Called after each strike, by one thread at a time.
using StrikeTick = std::function<void(const StrikePlace& place, const RandomStrike& strike)>;

/// `per_fault` of each, `jobs` at a time; the order and the outcome depend on the seed alone. First one of each, then
/// the second; what is known is not struck again.
std::vector<RandomStrike> strike_at_random(const std::vector<const Case*>& faults, int per_fault, std::uint64_t seed,
                                           int jobs, const StrikeTick& tick, const KnownStrikes& known = {});

/// A line a throw.
std::string strikes_csv(const std::vector<RandomStrike>& strikes);
/// A line a fault, then every throw that did not end as it should, or too late.
std::string strikes_page(const std::vector<RandomStrike>& strikes);
/// Whether none was let go outside its window, none carried over that could stop, and all stand.
bool safe(const std::vector<RandomStrike>& strikes);

}  // namespace hogline::faults
