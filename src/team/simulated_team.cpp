#include "src/team/simulated_team.hpp"

#include <cassert>
#include <utility>

#include "hw/sim/mixed_bits.hpp"
#include "src/skip/skip_vision.hpp"

namespace hogline {
namespace {

constexpr double mid_sheet_m = 12.0;
constexpr Duration link_latency = std::chrono::milliseconds(2);  // doc/link.md: p99 of a release between two processes

TeamRequest for_eyes(TeamRequest request) {
  if (request.eyes == Eyes::oracle) {
    request.thrower = with_small_pictures(std::move(request.thrower));
    request.skip = with_small_pictures(std::move(request.skip));
  }
  return request;
}

hw::sim::Scenario skip_scenario(const TeamRequest& request) {
  hw::sim::Scenario scenario = request.scenario;
  scenario.near_camera.rate_hz = scenario.skip->far_camera.rate_hz = request.skip_hz;
  return scenario;
}

/// Keeps what there is to show.
class KeepingSeer final : public SkipSeer {
 public:
  KeepingSeer(std::unique_ptr<SkipSeer> seer, SkipSights& sights) : seer_(std::move(seer)), sights_(sights) {}

  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override {
    servo::NearSight seen = seer_->near_view(frame, q, known);
    if (seen.sheet.ok && seen.stones.ok) sights_.house = {frame, seen};
    return seen;
  }
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override {
    FarPercept seen = seer_->far_view(frame, q, known);
    const bool mid_sheet = known.thrown && known.thrown->y_m > mid_sheet_m;
    if (seen.ok && !seen.stones.empty() && mid_sheet) sights_.far = {frame, seen};
    return seen;
  }

 private:
  std::unique_ptr<SkipSeer> seer_;
  SkipSights& sights_;
};

}  // namespace

SimulatedTeam::SimulatedTeam(const TeamRequest& request)
    : request_(request),
      robot_(for_eyes(request).thrower, request.scenario, request.render_threads),
      skip_robot_(for_eyes(request).skip, skip_scenario(request), request.render_threads),
      rink_(robot_.rink(), skip_robot_.rink(), request.scenario.robot, request.scenario.seed),
      crew_(rink_, request.scenario.sheet.width_m, request.scenario.stone.radius_m),
      team_(robot_.rink().clock(), link_latency),
      period_(request.thrower.drive.timing.control_period),
      thrower_(std::make_unique<ThrowerMember>(
          request_.thrower, robot_.devices(), [this] { return thrower_seer(); }, team_.join("thrower"))),
      skip_(std::make_unique<SkipMember>(
          request_.skip, skip_robot_.devices(), [this] { return skip_seer(); }, team_.join("skip"))) {
  assert(request.skip.head.timing.control_period == period_);
}

SimulatedTeam::~SimulatedTeam() = default;

void SimulatedTeam::step() {
  const Stamp end = now() + period_;
  if (const auto due = thrower_->release_due(); due && *due < end) {
    if (*due > now()) rink_.step(*due - now());
    thrower_->let_go(now());
  }
  if (now() < end) rink_.step(end - now());
  thrower_->step(now(), period_);
  skip_->step(now(), period_);
  crew_.watch();
}

std::unique_ptr<SheetSeer> SimulatedTeam::thrower_seer() {
  const auto& rig = request_.thrower.rig;
  if (request_.eyes == Eyes::oracle) {
    return std::make_unique<OracleSeer>(robot_.rink().history(), request_.scenario.sheet.width_m,
                                        OracleMounts{.near = rig.near_camera->mount, .low = rig.low_camera->mount},
                                        measured_quality(), hw::sim::mixed_bits(request_.scenario.seed) + ++throws_);
  }
  auto seer = std::make_unique<VisionSeer>(*rig.near_camera, *rig.low_camera, Looking::following);
  thrower_eyes_ = seer.get();
  return seer;
}

std::unique_ptr<SkipSeer> SimulatedTeam::skip_seer() {
  if (request_.eyes == Eyes::oracle) {
    return std::make_unique<SkipOracle>(skip_robot_.rink(), skip_robot_.scenario(), request_.skip, skip_robot_.axes(),
                                        SkipOracleQuality{}, ++throws_);
  }
  return std::make_unique<KeepingSeer>(std::make_unique<SkipVision>(request_.skip), sights_);
}

}  // namespace hogline
