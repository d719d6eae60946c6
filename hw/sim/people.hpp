// Who stands or walks beside the run.
#pragma once

#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/scenario.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Where everybody is at a moment: on either side of the sheet, no nearer to the centre line than the scenario says,
/// between 2 m behind the tee and 8 m ahead of it. Depends on the seed and the stamp alone.
std::vector<PersonLook> people_at(const PeopleScenario& scenario, std::uint64_t seed, Stamp stamp);

}  // namespace hogline::hw::sim
