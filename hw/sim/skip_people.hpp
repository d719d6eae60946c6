// Who walks on the ice while a stone comes: sweepers beside it, and passers in the skip's line of sight.
#pragma once

#include <optional>
#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

/// At `after_release_s`, about the thrown stone where it is then. `eye_x_m`, `eye_y_m`: of the skip's head, in e. What
/// they look like depends on the seed alone.
std::vector<PersonLook> people_about(const StoneTruth& thrown, double after_release_s, const SkipScenario& skip,
                                     double eye_x_m, double eye_y_m, std::uint64_t seed);

/// Whether a person stands between an eye and a place on the ice: the person taken as an upright cylinder.
bool hides(const PersonLook& person, const std::array<double, 3>& eye_m, const std::array<double, 3>& place_m);

}  // namespace hogline::hw::sim
