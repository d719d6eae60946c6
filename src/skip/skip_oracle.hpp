// Sees what vision would see of the stones, from the simulator's truth: for sets of many throws.
#pragma once

#include <random>

#include "hw/sim/skip_cameras.hpp"
#include "src/config/skip_rig.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

/// Errors of one view's looks: standard deviations.
struct StoneSightQuality {
  double across_rad = 0.0;       ///< of the bearing,
  double across_least_m = 0.0;   ///< and never less than this
  double along_m = 0.0;          ///< of the range, near by,
  double tilt_rad = 0.0;         ///< and by a tilt of its own in each picture,
  double shared_tilt_rad = 0.0;  ///< and by one that all pictures of a throw share
  double missing_share = 0.0;    ///< of the stones in sight that are not found
  double clutter = 0.0;          ///< false looks a picture
};

struct SkipOracleQuality {
  StoneSightQuality far{.across_rad = 4e-4,
                        .across_least_m = 0.004,
                        .along_m = 0.010,
                        .tilt_rad = 2e-4,
                        .shared_tilt_rad = 1.9e-4,
                        .missing_share = 0.05,
                        .clutter = 0.01};
  StoneSightQuality near{.across_rad = 5e-4,
                         .across_least_m = 0.003,
                         .along_m = 0.005,
                         .tilt_rad = 1.5e-4,
                         .shared_tilt_rad = 2.0e-4,
                         .missing_share = 0.02,
                         .clutter = 0.005};
  double place_m = 0.002;  ///< of the body
  double yaw_rad = 0.0003;
};

/// Stones in the picture that nobody stands before are seen where they are, with an error. Pictures are not looked at.
class SkipOracle final : public SkipSeer {
 public:
  /// Rink and scenario must outlive it. Another throw of a game has other errors.
  SkipOracle(const hw::sim::SkipRink& rink, const hw::sim::Scenario& scenario, const config::SkipRig& rig,
             const hw::sim::HeadAxes& axes, const SkipOracleQuality& quality, std::uint64_t throw_number = 0);

  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override;
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override;

 private:
  struct View {
    vision::CameraSetup setup;
    StoneSightQuality quality;
    double shared_tilt_rad = 0.0;
  };
  std::vector<StoneSighting> look(const View& view, const vision::Pose& eMc, const hw::sim::SkipMoment& moment,
                                  bool handles);
  StoneSighting sighting(const hw::sim::FieldStone& stone, const View& view, const Eigen::Vector3d& eye, bool handles);
  double normal() { return normal_(random_); }

  const hw::sim::SkipRink& rink_;
  const hw::sim::Scenario& scenario_;
  hw::sim::HeadAxes axes_;
  View far_;
  View near_;
  SkipOracleQuality quality_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace hogline
