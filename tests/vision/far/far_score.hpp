// How far looks compare with the truth: over many scenes, spread and bias.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/random_far_scene.hpp"
#include "vision/far_view/far_view.hpp"

namespace hogline::vision::testing {

FarSetup far_setup_of(const CameraSetup& camera);
FarPlan far_plan_of(const hogline::testing::FarScene& far);

/// Five to eight stones, with people, neighbours' stones and logos.
hogline::testing::FarMix crowded();
/// No stone on the sheet, but people, logos and stones of the next sheets.
hogline::testing::FarMix nobodys_stones();

/// A look at the scene's picture from its plan.
FarPercept look_far(const hogline::testing::FarScene& far);

struct FarScore {
  int refused = 0;
  int in_sight = 0;  ///< stones, by their geometry: half the handle, four fifths of handle and body
  int missed = 0;
  int ghosts = 0;
  int wrong_team = 0;                               ///< the other one's
  int unknown_team = 0;                             ///< nobody's
  std::vector<double> across_m, along_m;            ///< errors
  std::vector<double> across_sigmas, along_sigmas;  ///< the same in whole sigmas
  std::vector<double> tilt_rad, tilt_sigmas;        ///< errors of the corrected tilt
  std::vector<std::string> failures;

  static double rms(const std::vector<double>& values);
  static double mean(const std::vector<double>& values);
};

/// What was seen of a scene against its truth: each stone has the sighting that is nearest, and each sighting one
/// stone.
void add_look(const hogline::testing::FarScene& far, const FarPercept& seen, FarScore& score);

/// `count` scenes from seed `first` on.
FarScore score_far(std::uint64_t first, int count, const hogline::testing::FarMix& mix);

}  // namespace hogline::vision::testing
