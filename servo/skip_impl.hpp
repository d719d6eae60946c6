// The inside of Skip: what its states share. Included by skip*.cpp only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/place_average.hpp"
#include "servo/skip.hpp"
#include "servo/standing_stones.hpp"

namespace hogline::servo {

struct Skip::Impl {
  Impl(const SkipConfig& skip_config, const IceEstimate& ice_estimate, Stamp start)
      : config(skip_config), ice(ice_estimate), aiming(config.aiming), since(start) {}

  // skip.cpp: the machine
  SkipCommand step(const SkipObservation& o, Duration dt);
  void supervise(const SkipObservation& o);
  void enter(SkipState next, Stamp now);
  SkipCommand stop(std::string why, Stamp now);
  void finish(Stamp now);
  void lose_head(std::string why);
  void lose_sight(std::string why);

  // skip_waiting.cpp: the states before a stone is thrown
  SkipCommand boot(const SkipObservation& o);
  SkipCommand look(const SkipObservation& o);
  SkipCommand aim(const SkipObservation& o);
  SkipCommand wait(const SkipObservation& o);
  bool stands(const SkipObservation& o);
  void begin_watch(Stamp now, const PlanarPose& body, const PlanarSigma& sigma);

  // skip_sight.cpp: what the pictures tell
  void take_in(const SkipObservation& o);
  void take_near(const NearSight& near);
  void take_far(const FarPercept& far);
  void steer(const FarPercept& far);
  bool stands_elsewhere(const PlanarPose& seen) const;

  // skip_following.cpp: the thrown stone runs
  SkipCommand follow(const SkipObservation& o, Duration dt);
  SkipCommand track(const SkipObservation& o, Duration dt);
  GazeTarget target(Stamp stamp) const;
  bool near_wanted(Stamp now) const;
  void note_world(Stamp now);

  SkipConfig config;
  IceEstimate ice;
  HeadAiming aiming;
  SkipState state = SkipState::boot;
  Stamp since;

  PlaceAverage place;
  StandingStones standing;
  std::string last_reason = "no picture came";
  std::optional<Stamp> head_stands_since;
  bool pointed = false;

  std::optional<CollisionWatch> watch;
  std::optional<GazeTarget> last_target;  // where the thrown stone was last, once it is gone or at rest
  Stamp pose_seen{};
  Stamp far_seen{};
  std::optional<Stamp> quiet_since;
  bool head_lost = false;
  bool sight_lost = false;
  std::vector<std::string> remarks;
  SkipDiagnosis diagnosis;
  SkipReport report;
};

}  // namespace hogline::servo
