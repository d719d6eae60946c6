#include "vision/low_percept.hpp"

#include <gtest/gtest.h>

namespace hogline::vision {
namespace {

CameraSetup setup() {
  CameraSetup s;
  s.mount.z_m = 0.4;
  return s;
}

SheetFitResult fit(double bleed_px) {
  SheetFitResult result;
  result.ok = true;
  result.eMc = Pose::Identity();
  result.eMc.translation() << 0.0, rules::tee_to_hog_m - 3.0, 0.4;
  result.covariance.setIdentity();
  result.hog_distance_sigma_m = 0.002;
  result.bleed_px = bleed_px;
  result.bleed_sigma_px = 0.04;
  result.bleed_y_m = 0.5 * bleed_px;
  return result;
}

double sigma_m(double bleed_px) {
  SheetPosePercept percept;
  fill_low_percept(fit(bleed_px), setup(), percept);
  return percept.hog_distance_sigma_m;
}

// A claim that leaps where the edges' shift leaves its own noise would make a run end for a hundredth of a pixel.
TEST(LowPercept, TheClaimGrowsSteadilyWithWhatTheEdgesShiftMoreThanTheirNoise) {
  EXPECT_DOUBLE_EQ(sigma_m(0.0), sigma_m(0.039));
  EXPECT_NEAR(sigma_m(0.041), sigma_m(0.039), 0.0001);
  for (double bleed_px = 0.05; bleed_px < 0.15; bleed_px += 0.01) {
    EXPECT_GT(sigma_m(bleed_px + 0.01), sigma_m(bleed_px)) << bleed_px;
    EXPECT_DOUBLE_EQ(sigma_m(-bleed_px), sigma_m(bleed_px)) << bleed_px;
    EXPECT_LT(0.5 * bleed_px, 4.0 * sigma_m(bleed_px)) << "were all of it an error of the distance";
  }
}

}  // namespace
}  // namespace hogline::vision
