// A sheet with sliding stones for the skip's tests: FCV1 in millisecond steps (the simulated rink's), discs that
// collide, and two views with noise and errors of their own. Frame e of the skip unless a test says otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "hw/sim/stone_motion.hpp"
#include "servo/throw_fit.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo::test {

inline constexpr double step_s = 1e-3;
inline const Stamp throw_start = Stamp(std::chrono::seconds(100));

/// Scenario with the factors of an ice.
hw::sim::StoneScenario scenario_of(const IceFactors& ice);

struct PlantStone {
  hw::sim::StoneTruth motion;
  Team team = Team::first;
};

struct PlantContact {
  Stamp stamp{};
  int striker = 0;  ///< the faster one
  int struck = 0;
  double struck_mps = 0.0;  ///< its speed afterwards
};

/// Discs of 0.145 m with restitution and friction between them.
class ThrowPlant {
 public:
  ThrowPlant(std::vector<PlantStone> stones, const IceFactors& ice, double restitution = 0.9, double friction = 0.1);
  void step();
  Stamp now() const { return now_; }
  const std::vector<PlantStone>& stones() const { return stones_; }
  const std::vector<PlantContact>& contacts() const { return contacts_; }
  bool all_rest() const;

 private:
  void collide(std::size_t a, std::size_t b);
  std::vector<PlantStone> stones_;
  hw::sim::StoneScenario scenario_;
  double restitution_;
  double friction_;
  Stamp now_ = throw_start;
  std::vector<PlantContact> contacts_;
};

/// How a view sees: its camera, its looks' own noise, and the tilt error that all its looks share.
struct PlantView {
  View view = View::near;
  double camera_x_m = 0.0;
  double camera_y_m = -4.0;
  double camera_height_m = 2.0;
  double across_rad = 5e-4;  ///< noise of the bearing
  double across_least_m = 0.005;
  double along_m = 0.010;          ///< noise of the range, near by,
  double tilt_noise_rad = 2e-4;    ///< and with the range's square
  double tilt_sigma_rad = 1.9e-4;  ///< of the shared error
};

/// 150 mm RMS along the sheet at the far hog line, half of it shared; about 25 mm at the near one.
PlantView far_view();
/// 13 mm RMS in the house, 25 mm at the hog line.
PlantView near_view();

/// A look at a place, with its honest covariance. `tilt_rad`: the view's shared error of this throw.
TrackLook look_at(double x_m, double y_m, Stamp stamp, const PlantView& view, double tilt_rad, std::mt19937_64& random);

}  // namespace hogline::servo::test
