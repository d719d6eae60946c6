#include "src/team/robots_throw.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "servo/skip_sheet.hpp"
#include "servo/stone_path.hpp"
#include "src/team/seen_trajectory.hpp"
#include "src/team/stone_names.hpp"
#include "src/team/turn_order.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using game::ThrowEnd;
using game::ThrowReport;
using servo::side_of;

constexpr int most_attempts = 3;
constexpr Duration prepare_limit = std::chrono::seconds(30);
constexpr Duration answer_limit = std::chrono::seconds(2);
constexpr Duration throw_limit = std::chrono::seconds(90);
constexpr Duration rest_limit = std::chrono::seconds(60);  // no stone runs longer
constexpr Duration count_limit = std::chrono::seconds(30);
constexpr double speed_sigma_mps = 0.006;  // doc/performance.md: its campaigns
constexpr double heading_sigma_rad = 0.03 * std::numbers::pi / 180.0;
constexpr double spin_radps = 1.5;
constexpr int path_periods = 20;
constexpr Duration stone_told_every = std::chrono::seconds(4);
constexpr double speed_reserve_mps = 0.1;

std::string words(const game::Turn& turn) {
  return fmt::format("stone {} of team{}", turn.stone + 1, side_of(turn.team));
}

}  // namespace

double IceLesson::error_m() const { return std::hypot(rest.x_m - foretold.x_m, rest.y_m - foretold.y_m); }

servo::ThrowerSkill skill_of(const config::ThrowerRig& rig) {
  const servo::ReleaseConfig& release = rig.thrower.release;
  const double y_m = vision::rules::tee_to_hack_m + vision::rules::tee_to_hog_m - release.hog_distance_m;
  return {.release = {0.0, y_m + release.stone_x_m},
          .max_speed_mps = rig.thrower.limits.max_speed_mps - speed_reserve_mps,
          .spin_radps = spin_radps,
          .speed_sigma_mps = speed_sigma_mps,
          .heading_sigma_rad = heading_sigma_rad,
          .line_through_hack = true};
}

RobotsThrow::RobotsThrow(SimulatedTeam& team, const servo::ThrowerSkill& skill, const servo::IceModel& ice,
                         std::function<void(const TurnRecord&)> told, Progress progress)
    : team_(team), skill_(skill), ice_(ice), told_(std::move(told)), progress_(std::move(progress)) {}

void RobotsThrow::start(const game::Turn& turn, Stamp) {
  record_ = {};
  record_.turn = turn;
  began_ = team_.now();
  wall_began_ = std::chrono::steady_clock::now();
  prepare_attempt();
}

std::optional<ThrowReport> RobotsThrow::step(Stamp) {
  const Stamp until = team_.now() + std::chrono::seconds(1);
  while (phase_ != Phase::idle && team_.now() < until) {
    team_.step();
    if (auto report = advance()) return report;
  }
  return std::nullopt;
}

void RobotsThrow::enter(Phase phase, const std::string& what) {
  phase_ = phase;
  since_ = team_.now();
  if (progress_) progress_(seconds(since_ - began_), what);
}

void RobotsThrow::watch_truth() {
  if (!judge_ || !team_.thrower().loop()) return;
  const hw::sim::Truth& truth = team_.robot().rink().truth();
  judge_->watch(truth, team_.thrower().loop()->thrower());
  if (++periods_ % path_periods != 0) return;
  record_.robot_path.push_back({truth.body.x_m, truth.body.y_m});
  if (truth.release) record_.stone_path.push_back({truth.stone.x_m, truth.stone.y_m});
}

// A throw in rendered pictures takes as long as a real one: who watches sees that it goes on.
void RobotsThrow::tell_state() {
  const ThrowerLoop* loop = team_.thrower().loop();
  if (!progress_ || !loop || !team_.thrower().throwing()) return;
  const std::string state = to_string(loop->thrower().state());
  if (state != told_state_) progress_(seconds(team_.now() - began_), "the thrower: " + state);
  told_state_ = state;
}

void RobotsThrow::tell_stone() {
  const auto& stone = team_.skip().skip().diagnosis().thrown;
  if (!progress_ || !stone || team_.now() - stone_told_ < stone_told_every) return;
  stone_told_ = team_.now();
  progress_(seconds(stone_told_ - began_), fmt::format("the skip sees it {:.2f} m before the tee at {:.2f} m/s",
                                                       stone->y_m, servo::speed_mps(*stone)));
}

std::optional<ThrowReport> RobotsThrow::advance() {
  watch_truth();
  switch (phase_) {
    case Phase::idle:
      return std::nullopt;
    case Phase::preparing:
      return preparing();
    case Phase::ordered:
      return ordered();
    case Phase::following:
      following();
      return std::nullopt;
    case Phase::settling:
      settling();
      return std::nullopt;
    case Phase::counting:
      return counting();
  }
  return std::nullopt;
}

std::optional<ThrowReport> RobotsThrow::prepare_attempt() {
  ++record_.attempts;
  judge_.reset();
  told_state_.clear();
  record_.robot_path.clear();
  team_.crew().prepare(record_.turn.board, {side_of(record_.turn.team), record_.turn.stone});
  record_.true_before = team_.crew().lying();
  team_.thrower().load();
  team_.skip().begin(ice_.estimate(), team_.now());
  enter(Phase::preparing, "the robot stands in the hack with " + words(record_.turn) + "; the skip looks");
  return std::nullopt;
}

std::optional<ThrowReport> RobotsThrow::preparing() {
  const std::string thrower = team_.thrower().not_ready();
  if (thrower.empty() && team_.skip().waits()) return decide();
  if (team_.skip().over()) return failed("the skip: " + team_.skip().skip().report().reason);
  if (team_.now() - since_ < prepare_limit) return std::nullopt;
  return failed(thrower.empty() ? "the skip does not come to wait for the stone" : "the thrower: " + thrower);
}

std::optional<ThrowReport> RobotsThrow::decide() {
  const servo::SkipDiagnosis& known = team_.skip().skip().diagnosis();
  record_.before = known.standing;
  TurnOrder order = order_of(record_.turn, record_.before, known.sheet_width_m, skill_, ice_);
  names_ = std::move(order.names);
  record_.remarks.insert(record_.remarks.end(), order.remarks.begin(), order.remarks.end());
  ThrowReport& report = record_.report;
  report.mapped = order.mapped;
  if (!order.refused.empty()) return closed(ThrowEnd::refused, order.refused);
  report.order = order.order;
  team_.skip().order(report.order, ++shot_, record_.turn.team, team_.now());
  servo::ShotOrder thrown = report.order;
  thrown.release_x_m = release_place(skill_, thrown.heading_rad).x_m;
  judge_.emplace(team_.request().thrower.thrower, team_.robot().scenario(), thrown, team_.now());
  enter(Phase::ordered, fmt::format("ordered: {:.3f} m/s, {:+.3f} deg, {}", report.order.speed_mps,
                                    report.order.heading_rad * 180.0 / std::numbers::pi,
                                    report.order.curl == servo::Curl::clockwise ? "cw" : "ccw"));
  return std::nullopt;
}

std::optional<ThrowReport> RobotsThrow::ordered() {
  tell_state();
  const OrderPhase phase = team_.skip().ordered();
  if (phase == OrderPhase::released) {
    stone_told_ = team_.now();
    enter(Phase::following, "released");
    return std::nullopt;
  }
  const Duration waited = team_.now() - since_;
  const bool silent = phase == OrderPhase::sent && waited > answer_limit;
  const bool still_brakes = phase == OrderPhase::refused && team_.thrower().throwing();
  if (still_brakes && waited < throw_limit) return std::nullopt;
  if (phase == OrderPhase::refused || silent || waited > throw_limit) return failed(team_.skip().why());
  return std::nullopt;
}

std::optional<ThrowReport> RobotsThrow::failed(const std::string& why) {
  record_.remarks.push_back(fmt::format("attempt {}: {}", record_.attempts, why));
  if (team_.crew().stone_is_gone()) {
    record_.remarks.push_back("the stone has left the hack: it is not thrown again");
    enter(Phase::settling, "lost: " + why);
    return std::nullopt;
  }
  if (progress_) progress_(seconds(team_.now() - began_), "not thrown: " + why);
  if (record_.attempts >= most_attempts || team_.thrower().throwing()) return closed(ThrowEnd::failed, why);
  return prepare_attempt();
}

void RobotsThrow::following() {
  tell_stone();
  const servo::Skip& skip = team_.skip().skip();
  const servo::SkipDiagnosis& known = skip.diagnosis();
  const bool far_off = known.thrown && known.thrown->y_m > servo::hog_line_m;
  if (known.stop && (far_off || !record_.foretold)) record_.foretold = known.stop;
  if (!skip.finished()) return;
  record_.release = team_.skip().release();
  record_.followed = skip.report();
  if (!skip.report().ok) record_.remarks.push_back("the skip: " + skip.report().reason);
  enter(Phase::settling, skip.report().ok ? "all lies still" : "not followed to its end: " + skip.report().reason);
}

// Nobody counts stones that run, and nobody walks before a robot that drives.
void RobotsThrow::settling() {
  const bool still = team_.crew().all_at_rest() || team_.now() - since_ > rest_limit;
  if (!still || team_.thrower().throwing()) return;
  team_.skip().begin(ice_.estimate(), team_.now());
  enter(Phase::counting, "the skip counts");
}

std::optional<ThrowReport> RobotsThrow::counting() {
  if (team_.skip().has_looked()) {
    record_.counted = team_.skip().skip().diagnosis().standing;
    return ended();
  }
  if (!team_.skip().over() && team_.now() - since_ < count_limit) return std::nullopt;
  record_.remarks.push_back("not counted: " + (team_.skip().over() ? team_.skip().skip().report().reason : "too late"));
  if (!record_.followed || !record_.followed->ok) {
    return closed(ThrowEnd::failed, "the stones were neither followed to rest nor counted");
  }
  return ended();
}

ThrowReport RobotsThrow::ended() {
  SeenThrow seen{.before = record_.turn.board,
                 .thrown = {side_of(record_.turn.team), record_.turn.stone},
                 .names = names_,
                 .followed = std::nullopt,
                 .counted = record_.counted};
  if (record_.followed) seen.followed = record_.followed->result;
  StonesAfter after = stones_after(seen);
  record_.report.seen = after.stones;
  record_.report.trajectory = seen_trajectory(seen, after.stones.lying);
  record_.remarks.insert(record_.remarks.end(), after.remarks.begin(), after.remarks.end());
  if (record_.counted) record_.report.seen_sigma_m = house_sigma_m(*record_.counted);
  learn();
  return closed(ThrowEnd::thrown, {});
}

// What the release and the ice were known to be foretold a place; the stone lies elsewhere, and the ice model learns.
void RobotsThrow::learn() {
  if (!record_.followed) return;
  const servo::ThrowResult& result = record_.followed->result;
  IceLesson lesson{.foretold = {}, .rest = {}, .before = ice_.estimate(), .after = {}};
  const Eigen::Matrix3d ice_covariance = ice_.throw_covariance();
  const bool touch_not_seen =
      record_.report.seen.struck && result.collisions.empty();  // its track is not free to the end
  if (result.track && !touch_not_seen) ice_.learn(servo::from_other_end(*result.track));
  lesson.after = ice_.estimate();
  const auto& thrown = record_.report.seen.lying.stones[side_of(record_.turn.team)][record_.turn.stone];
  if (!record_.release || !thrown || record_.report.seen.struck) return;
  const servo::SlidingStone stone = servo::released(
      {.speed_mps = record_.release->speed_mps,
       .heading_rad = record_.release->heading_rad,
       .curl = record_.release->spin_radps < 0.0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise,
       .spin_radps = std::abs(record_.release->spin_radps)},
      {record_.release->lateral_m, skill_.release.y_m});
  Eigen::Matrix<double, 7, 7> covariance = Eigen::Matrix<double, 7, 7>::Zero();
  covariance(2, 2) = std::pow(stone.vy_mps * skill_.heading_sigma_rad, 2);
  covariance(3, 3) = std::pow(skill_.speed_sigma_mps, 2);
  covariance.bottomRightCorner<3, 3>() = ice_covariance;
  lesson.foretold = servo::predict_stop(stone, lesson.before.factors(), covariance);
  lesson.rest = {thrown->x_m, thrown->y_m};
  record_.lesson = lesson;
}

ThrowReport RobotsThrow::closed(ThrowEnd end, const std::string& reason) {
  record_.report.end = end;
  record_.report.reason = reason;
  record_.ice = ice_.estimate();
  record_.truth = team_.crew().truth();
  if (judge_ && team_.thrower().loop()) {
    record_.thrower = judge_->verdict(team_.robot().rink().truth(), team_.thrower().loop()->thrower(), team_.now());
  }
  record_.simulated_s = seconds(team_.now() - began_);
  record_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_began_).count();
  phase_ = Phase::idle;
  if (told_) told_(record_);
  return record_.report;
}

}  // namespace hogline
