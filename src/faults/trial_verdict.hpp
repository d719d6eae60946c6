// Whether a trial ended as its case expects.
#pragma once

#include "src/faults/fault_trial.hpp"

namespace hogline::faults {

/// Adds to the finding's failures whatever is not as expected, each with its figures, and says whether the robot braked
/// as a quick stop does. `struck`: the fault was injected.
void judge(const Case& fault, bool struck, Finding& finding);

}  // namespace hogline::faults
