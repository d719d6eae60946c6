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

/// A look at the scene's picture from its plan.
FarPercept look_far(const hogline::testing::FarScene& far);

struct FarScore {
  int refused = 0;
  int in_sight = 0;  ///< stones, by their geometry: half the handle, four fifths of handle and body
  int missed = 0;
  int ghosts = 0;
  int wrong_team = 0;
  std::vector<double> across_m, along_m;            ///< errors
  std::vector<double> across_sigmas, along_sigmas;  ///< the same in whole sigmas
  std::vector<double> tilt_rad, tilt_sigmas;        ///< errors of the corrected tilt
  std::vector<std::string> failures;

  static double rms(const std::vector<double>& values);
  static double mean(const std::vector<double>& values);
};

/// `count` scenes from seed `first` on.
FarScore score_far(std::uint64_t first, int count, const hogline::testing::FarMix& mix);

}  // namespace hogline::vision::testing
