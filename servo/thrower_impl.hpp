// The inside of Thrower: what its states share. Included by thrower*.cpp only.
#pragma once

#include <optional>

#include "servo/jaw_rehearsal.hpp"
#include "servo/line_tracking.hpp"
#include "servo/place_average.hpp"
#include "servo/release.hpp"
#include "servo/safety/input_check.hpp"
#include "servo/safety/latch.hpp"
#include "servo/safety/turn_agreement.hpp"
#include "servo/slip_watch.hpp"
#include "servo/speed_profile.hpp"
#include "servo/thrower.hpp"
#include "servo/thrower_estimate.hpp"
#include "servo/yaw_alignment.hpp"

namespace hogline::servo {

struct Thrower::Impl {
  Impl(const ThrowerConfig& config, const ShotOrder& order, Stamp start);

  // thrower.cpp: the machine
  ThrowerCommand step(const ThrowerObservation& observation, Duration dt);
  std::optional<std::string> judge(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand act(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand stop_for_good(const ThrowerObservation& observation, Duration dt);
  void enter(ThrowerState next, Stamp now);
  void diagnose(Stamp now);
  InputNeeds needs(const ThrowerObservation& observation) const;
  EstimateUse use() const;
  Duration deadline() const;
  std::string missing_view(const ThrowerObservation& o) const;

  // thrower_standing.cpp: the states before the run
  ThrowerCommand unfold(const ThrowerObservation& observation);
  ThrowerCommand rehearse(const ThrowerObservation& observation);
  ThrowerCommand measure(const ThrowerObservation& observation);
  ThrowerCommand align(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand fold(const ThrowerObservation& observation, Duration dt);
  std::optional<std::string> run_does_not_fit(double hog_distance_m) const;
  SheetPosePercept near_view(const ThrowerObservation& observation) const;  // its known bias taken off
  void begin_line(Stamp now, const StandingPlace& here);
  double turn_to_heading(Stamp now, Duration dt, bool& settled);

  // thrower_running.cpp: the run and after
  ThrowerCommand run(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand release(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand brake(const ThrowerObservation& observation, Duration dt);
  ThrowerCommand stopped() const;
  ReleaseOutlook outlook(const ThrowerObservation& observation, Duration dt) const;
  std::optional<std::string> last_chance_missed(const ReleaseOutlook& outlook) const;
  bool has_come_to_rest(const ThrowerObservation& observation, Duration dt);
  DriveCommand drive(double true_speed_mps, Stamp now, double to_release_s, Duration dt);
  DriveCommand velocity(const PlanarTwist& twist) const;
  double spin_radps() const;
  double run_speed_mps() const { return order.speed_mps + config.release.drag_mps; }
  void advance_profile(const ThrowerObservation& observation, Duration dt);
  std::optional<std::string> out_of_sight(Stamp now, double hog_distance_m);
  bool stone_is_free(const ThrowerObservation& observation);
  FreedStone freed_stone(Stamp at, const ThrowerObservation& observation) const;

  ThrowerConfig config;
  ShotOrder order;
  ThrowerState state = ThrowerState::unfold;
  std::vector<StateEntry> history;
  ThrowerDiagnosis diagnosis;
  Latch abort;
  TurnAgreement agreement;
  ThrowerEstimate estimate;
  std::optional<Stamp> last_now;

  JawRehearsal rehearsal;                 // rehearse
  PlaceAverage place;                     // measure, align
  std::optional<StandingPlace> measured;  // measure: where the body stood before the turn
  std::optional<YawAlignment> alignment;  // align, fold
  Stamp moved{};                          // align: the last moment a turn was ordered
  std::optional<SpeedProfile> profile;    // run
  std::optional<LineTracking> tracking;   // run, release, brake
  SlipWatch slip;                         // run
  double profile_s = 0.0;                 // run: how far along the profile
  double profile_rate = 1.0;              // run: of the profile's time; after a slip it goes on more slowly
  double speed_setpoint_mps = 0.0;
  double driven_scale = 1.0;                // of the odometry, as passed on to the wheels
  std::optional<Stamp> sight_wanted_since;  // run: the hog line must have been in sight since
  bool release_ordered = false;
  Stamp release_at{};  // its moment, within the period in which it was ordered
  bool released = false;
  Duration at_rest_for{};
  bool at_rest = false;
};

}  // namespace hogline::servo
