// Every fault of the table, at random moments of random throws.
#pragma once

#include <cstdint>
#include <functional>
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

/// `per_fault` of each, `jobs` at a time; the order and the outcome depend on the seed alone. `tick` is called after
/// each.
std::vector<RandomStrike> strike_at_random(const std::vector<const Case*>& faults, int per_fault, std::uint64_t seed,
                                           int jobs, const std::function<void()>& tick);

/// A line a throw.
std::string strikes_csv(const std::vector<RandomStrike>& strikes);
/// A line a fault, then every throw that did not end as it should, or too late.
std::string strikes_page(const std::vector<RandomStrike>& strikes);
/// Whether none was let go outside its window, none carried over that could stop, and all stand.
bool safe(const std::vector<RandomStrike>& strikes);

}  // namespace hogline::faults
