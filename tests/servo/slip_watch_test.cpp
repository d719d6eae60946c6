#include "servo/slip_watch.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

struct Ride {
  SlipWatch watch;
  Stamp now{std::chrono::seconds(100)};
  double hog_m = 9.0;
  std::mt19937 random{7};
  int since_look = 0;

  void go(double seconds_long, double wheels_mps, double body_mps, double sigma_m = 0.003) {
    std::normal_distribution<double> noise(0.0, sigma_m);
    for (Stamp end = now + from_seconds(seconds_long); now < end;) {
      now += period;
      hog_m -= body_mps * seconds(period);
      watch.wheels(now, wheels_mps);
      if (++since_look % 4 == 0) watch.look(now, hog_m + noise(random), sigma_m);
    }
  }
};

TEST(SlipWatch, FindsWheelsThatSpinWithinAThirdOfASecondAndTheEndOfIt) {
  for (const double slip : {0.15, 0.3, -0.3}) {
    Ride ride;
    ride.go(1.0, 1.5, 1.5);
    ASSERT_FALSE(ride.watch.ever());
    ride.go(0.33, 1.5 + slip, 1.5);
    EXPECT_TRUE(ride.watch.slipping()) << slip;
    EXPECT_NEAR(ride.watch.slip_mps(), slip, 0.07);
    ride.go(0.4, 1.5, 1.5);
    EXPECT_FALSE(ride.watch.slipping());
    EXPECT_TRUE(ride.watch.ever());
  }
}

TEST(SlipWatch, DoesNotTakeNoiseOrASmallScaleErrorForSlip) {
  for (const double sigma_m : {0.002, 0.01, 0.03}) {
    for (const double speed : {0.3, 2.0, 3.4}) {
      Ride ride;
      ride.go(2.0, 1.01 * speed, speed, sigma_m);
      EXPECT_FALSE(ride.watch.ever()) << sigma_m << " " << speed;
    }
  }
}

TEST(SlipWatch, SaysNothingWithoutLooks) {
  Ride ride;
  for (int i = 0; i < 100; ++i) ride.watch.wheels(ride.now + i * period, 2.0);
  EXPECT_FALSE(ride.watch.slipping());
  ride.watch.look(Stamp{}, 3.0, 0.01);
  EXPECT_FALSE(ride.watch.ever());
}

}  // namespace
}  // namespace hogline::servo::test
