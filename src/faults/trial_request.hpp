// The throw in which a fault strikes: the practice rink, seen by the oracle, prepared as the case asks.
#pragma once

#include "src/faults/fault_trial.hpp"

namespace hogline::faults {

constexpr double trial_speed_mps = 2.5;  ///< of the stone at release, in the table's throws

/// The table's own throw, the same for each case but for what the case prepares.
ThrowRequest request_of(const Case& fault);

/// The same with the moment's rink and order.
ThrowRequest request_of(const Case& fault, const Moment& moment);

}  // namespace hogline::faults
