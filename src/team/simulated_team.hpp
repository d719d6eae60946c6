// Both robots on one simulated rink, in one process and in stepped time, with the people about it.
#pragma once

#include <memory>
#include <optional>

#include "hw/link/local_team_link.hpp"
#include "hw/sim/team_rink.hpp"
#include "src/skip/simulated_skip.hpp"
#include "src/team/rink_crew.hpp"
#include "src/team/skip_member.hpp"
#include "src/team/thrower_member.hpp"
#include "src/throwing/simulated_throw.hpp"

namespace hogline {

struct TeamRequest {
  config::ThrowerRig thrower;
  config::SkipRig skip;
  hw::sim::Scenario scenario;  ///< with its skip
  Eyes eyes = Eyes::oracle;    ///< of both
  double skip_hz = 20.0;       ///< of the skip's two cameras; the thrower's are the scenario's
  int render_threads = 2;
};

/// What the skip's cameras showed at telling moments, for pictures of the report.
struct SkipSights {
  struct Near {
    hw::Frame frame;
    servo::NearSight seen;
  };
  struct Far {
    hw::Frame frame;
    FarPercept seen;
  };
  std::optional<Near> house;  ///< the newest in which sheet and stones were seen
  std::optional<Far> far;     ///< the newest in which the thrown stone was seen in mid-sheet
};

class SimulatedTeam {
 public:
  explicit SimulatedTeam(const TeamRequest& request);
  ~SimulatedTeam();
  SimulatedTeam(const SimulatedTeam&) = delete;
  SimulatedTeam& operator=(const SimulatedTeam&) = delete;

  /// One control period.
  void step();
  Stamp now() const { return robot_.rink().now(); }
  Duration period() const { return period_; }

  ThrowerMember& thrower() { return *thrower_; }
  SkipMember& skip() { return *skip_; }
  RinkCrew& crew() { return crew_; }
  SimulatedRobot& robot() { return robot_; }
  SimulatedSkip& skip_robot() { return skip_robot_; }
  const TeamRequest& request() const { return request_; }
  const hw::sim::TeamRink& rink() const { return rink_; }

  /// Of the throw under way, or of the last one. By vision only.
  const VisionSeer* thrower_eyes() const { return thrower_eyes_; }
  const SkipSights& skip_sights() const { return sights_; }

 private:
  std::unique_ptr<SheetSeer> thrower_seer();
  std::unique_ptr<SkipSeer> skip_seer();

  TeamRequest request_;
  SimulatedRobot robot_;
  SimulatedSkip skip_robot_;
  hw::sim::TeamRink rink_;
  RinkCrew crew_;
  hw::link::LocalTeam team_;
  Duration period_;
  std::uint64_t throws_ = 0;  ///< and looks: each has its own errors
  const VisionSeer* thrower_eyes_ = nullptr;
  SkipSights sights_;
  std::unique_ptr<ThrowerMember> thrower_;
  std::unique_ptr<SkipMember> skip_;
};

}  // namespace hogline
