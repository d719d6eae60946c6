// One throw on the skip's simulated rink, from the head's boot to the rest of all stones.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hw/canopen/two_axis_head.hpp"
#include "hw/checks/checked_camera.hpp"
#include "hw/sim/skip_cameras.hpp"
#include "hw/sim/skip_rink.hpp"
#include "servo/ice_model.hpp"
#include "servo/skip.hpp"
#include "src/config/skip_rig.hpp"
#include "src/skip/skip_loop.hpp"
#include "src/skip/skip_oracle.hpp"
#include "src/skip/skip_scene.hpp"

namespace hogline {

/// The same adapters as on steel, connected to the rink's bus and pictures.
class SimulatedSkip {
 public:
  SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario, const SkipScene& scene,
                Duration released_after, int render_threads);
  /// An empty sheet to which nothing comes but what is delivered.
  SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario, int render_threads);
  SimulatedSkip(const SimulatedSkip&) = delete;
  SimulatedSkip& operator=(const SimulatedSkip&) = delete;

  SkipDevices devices() { return {head_, near_checked_, far_checked_}; }
  hw::sim::SkipRink& rink() { return rink_; }
  const hw::sim::SkipRink& rink() const { return rink_; }
  const hw::sim::Scenario& scenario() const { return scenario_; }
  const hw::sim::HeadAxes& axes() const { return axes_; }
  hw::sim::RenderedCamera& near_camera() { return near_camera_; }
  hw::sim::RenderedCamera& far_camera() { return far_camera_; }

 private:
  SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario, const hw::sim::SkipRinkConfig& rink,
                int render_threads);

  hw::sim::Scenario scenario_;
  hw::sim::HeadAxes axes_;
  hw::sim::SkipRink rink_;
  hw::TwoAxisHead head_;
  hw::sim::RenderedCamera near_camera_;
  hw::sim::RenderedCamera far_camera_;
  hw::CheckedCamera near_checked_;
  hw::CheckedCamera far_checked_;
};

enum class SkipEyes { vision, oracle };

struct SkipRequest {
  config::SkipRig rig;
  hw::sim::Scenario scenario;  ///< with its skip
  SkipScene scene;
  SkipEyes eyes = SkipEyes::oracle;
  bool announced = true;                              ///< the thrower tells when it lets go
  servo::IceEstimate ice;                             ///< in s, as known before the throw
  Duration released_after = std::chrono::seconds(9);  ///< the rink's start
  int render_threads = 1;
  std::string record{};                                    ///< folder for the pictures; empty: none are kept
  std::function<void(SimulatedSkip&, Stamp)> interfere{};  ///< called each control period: faults
};

/// What was and what was believed, once a picture of the far camera.
struct SkipSample {
  double t_s = 0.0;  ///< after the release
  servo::SkipState state = servo::SkipState::boot;
  hw::sim::StoneTruth truth;  ///< of the thrown stone
  bool on_ice = false;        ///< nobody has caught it
  bool out = false;           ///< by the rules
  double off_axis_rad = 0.0;  ///< of it from the far camera's axis, in truth
  double pan_rad = 0.0;       ///< in truth
  double tilt_rad = 0.0;
  std::optional<servo::SlidingStone> known;
  PlaceCovariance covariance;
  std::optional<servo::StopPrediction> stop;
};

/// What became of a stone in truth.
struct TrueStone {
  hw::sim::FieldStone start;  ///< as it stood, or was let go
  hw::sim::StoneTruth end;
  servo::StoneFate fate = servo::StoneFate::at_rest;
  double margin_m = 0.0;  ///< by which the fate is what it is
};

struct SkipOutcome {
  servo::SkipReport report;
  servo::SkipDiagnosis known;  ///< at the end
  servo::IceEstimate ice;      ///< in s, after the throw
  std::optional<Stamp> released;
  std::vector<SkipSample> samples;
  std::vector<TrueStone> stones;  ///< the thrown one last, where there was one
  std::vector<hw::sim::StoneContact> contacts;
  std::optional<double> true_hog_to_hog_s;
  std::vector<hw::sim::PasserScenario> passers;
  double least_room_rad = 0.0;  ///< of the head's joints to their limits
  int near_frames = 0;
  int far_frames = 0;
  double simulated_s = 0.0;
};

using SkipProgress = std::function<void(double t_s, servo::SkipState)>;
SkipOutcome follow_throw(const SkipRequest& request, const SkipProgress& progress = {});

/// The same rig with cameras of a sixteenth of the width and height: enough for what is not seen by vision.
config::SkipRig with_small_pictures(config::SkipRig rig);

/// In e of the skip, from the estimate in s, and with `spin_radps` as ordered.
servo::SkipConfig configured(const SkipRequest& request);

}  // namespace hogline
