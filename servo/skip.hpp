// The skip's state machine: look (sheet and stones, by the near view), aim (the head points at where the stone will
// come from), wait, follow (the head turns with the stone; far view, then near view), done.
//
// What can not be trusted stops the head and is said in the report; what was seen before stays true. Frame e of the
// skip.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "servo/skip_config.hpp"
#include "servo/throw_result.hpp"
#include "vision/percepts/far_look.hpp"
#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo {

enum class SkipState {
  boot,    ///< the head's drives start
  look,    ///< the sheet's pose and the standing stones
  aim,     ///< the head goes to where the stone will come from
  wait,    ///< for the stone
  follow,  ///< the stone, to the rest of all that moved
  done,
  stopped,  ///< before there was anything to follow; the report says why
};

const char* to_string(SkipState state);

struct HeadObservation {
  bool ready = false;    ///< waits for enable()
  bool enabled = false;  ///< takes commands
  bool on_target = false;
  std::optional<std::string> error;  ///< latched
  HeadJoints joints;
};

/// What one picture of the near camera showed.
struct NearSight {
  SheetPosePercept sheet;
  StonesPercept stones;
};

struct SkipObservation {
  Stamp now{};
  HeadObservation head;
  std::optional<NearSight> near;  ///< seen since the last period
  std::optional<FarPercept> far;
  std::optional<ReleaseSignal> release;   ///< told since the last period
  std::optional<std::string> near_error;  ///< of the cameras, latched
  std::optional<std::string> far_error;
};

struct SkipCommand {
  enum class Head { none, enable, point, track, stop };
  Head head = Head::none;
  HeadAngles target{};     ///< with point
  double pan_radps = 0.0;  ///< with track
  double tilt_radps = 0.0;
  bool near_wanted = false;  ///< which views are of use now
  bool far_wanted = false;
};

/// A stone on its way or at rest. Pictures are older than what is known when they are looked at: `at` tells for theirs.
struct ExpectedStone {
  Stamp stamp{};
  double x_m = 0.0, y_m = 0.0;
  double vx_mps = 0.0, vy_mps = 0.0;
  PlaceCovariance covariance;

  /// Where it should be in a picture of that moment, within a second of `stamp`.
  StoneExpectation at(Stamp moment) const {
    const double since_s = seconds(moment - stamp);
    return {x_m + since_s * vx_mps, y_m + since_s * vy_mps, covariance};
  }
};

/// What is known now, for drawings, logs and whoever looks at pictures next.
struct SkipDiagnosis {
  std::optional<PlanarPose> body;
  PlanarSigma body_sigma;
  std::optional<double> sheet_width_m;
  std::vector<StoneSighting> standing;  ///< before the throw
  std::optional<SlidingStone> thrown;   ///< now
  PlaceCovariance thrown_covariance;
  std::optional<StopPrediction> stop;  ///< where it will rest if nothing stands in its way; while it runs
  double off_axis_rad = 0.0;           ///< of the stone from the far view's axis, as far as is known
  bool head_limited = false;
  std::vector<ExpectedStone> expected;  ///< every stone
};

/// The end of it.
struct SkipReport {
  bool ok = false;     ///< a throw was followed to its end, and nothing was missing on the way
  std::string reason;  ///< why not, when !ok
  ThrowResult result;
  std::vector<std::string> remarks;  ///< what went wrong on the way, in its order
};

/// Pure: no clock, no thread, no device.
class Skip {
 public:
  Skip(const SkipConfig& config, const IceEstimate& ice, Stamp start);
  ~Skip();
  Skip(Skip&&) noexcept;
  Skip& operator=(Skip&&) noexcept;

  /// One control period. `observation.now` must not go back.
  SkipCommand step(const SkipObservation& observation, Duration dt);

  /// The spin that was ordered, where it was not known at the start: before the stone is let go.
  void expect(double spin_radps);

  /// Nothing more will come: reports what was seen up to now. No effect once finished.
  void conclude(Stamp now);

  SkipState state() const;
  bool finished() const;  ///< done or stopped
  const SkipDiagnosis& diagnosis() const;
  /// The world now; nothing before the stones were looked at.
  const CollisionWatch* watch() const;
  /// Precondition: finished.
  const SkipReport& report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::servo
