// A session on an unknown sheet: draws by a robot that is not quite true, seen by a skip. Frame s.
#pragma once

#include <cstdint>
#include <random>

#include "servo/ice_model.hpp"
#include "servo/shot_aiming.hpp"
#include "tests/servo/throw_plant.hpp"

namespace hogline::servo::test {

inline constexpr double far_tee_m = 38.405;
inline constexpr double skip_camera_y_m = far_tee_m + 4.0;

struct SheetOfIce {
  IceFactors ice;
  double throw_friction_sigma = 0.003;  ///< share by which each throw's friction differs
};

/// Friction 0.85-1.2, curl 0.6-1.1, lateral +-0.5 mm/s2, spin decay 0.5-2.
SheetOfIce unknown_sheet(std::mt19937_64& random);

/// 6 mm/s and 0.03 deg; lets go 0.9 m before the hog line.
ThrowerSkill robot();

struct Delivery {
  ThrowTrack track;
  SlidingStone start;  ///< true, at the release
  IceFactors ice;      ///< true, of this throw
  Place rest;          ///< true
};

/// 30 looks a second, far view up to the far hog line, near view from there on to half a second of rest.
Delivery deliver(const ShotOrder& order, const SheetOfIce& sheet, std::mt19937_64& random);

}  // namespace hogline::servo::test
