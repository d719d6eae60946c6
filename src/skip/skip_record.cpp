#include "src/skip/skip_record.hpp"

#include <algorithm>
#include <cmath>

#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

constexpr Duration sample_span = std::chrono::milliseconds(20);

double off_axis(const vision::Pose& eMc, const hw::sim::StoneTruth& stone, double height_m) {
  const Eigen::Vector3d c = eMc.inverse() * Eigen::Vector3d(stone.x_m, stone.y_m, height_m);
  return std::atan2(c.head<2>().norm(), c.z());
}

}  // namespace

SkipRecord::SkipRecord(const SkipRequest& request, const SimulatedSkip& robot) : request_(request), robot_(robot) {}

void SkipRecord::note(const SkipLoop& loop, Stamp now) {
  const hw::sim::SkipRink& rink = robot_.rink();
  follow_margins(rink.field(), margins_);
  if (!rink.released()) return;
  const hw::sim::FieldStone& thrown = rink.field().stones()[*rink.thrown()];
  const double y = thrown.motion.y_m;
  for (const double line : {servo::far_hog_line_m, servo::hog_line_m}) {
    if (!(last_y_m_ > line && y <= line) || last_y_m_ > 1e8) continue;
    const double share = (last_y_m_ - line) / (last_y_m_ - y);
    const Stamp at = last_stamp_ + from_seconds(share * seconds(now - last_stamp_));
    if (line == servo::far_hog_line_m) far_hog_ = at;
    if (line == servo::hog_line_m && far_hog_) hog_to_hog_s_ = seconds(at - *far_hog_);
  }
  last_y_m_ = y;
  last_stamp_ = now;
  if (now < next_sample_) return;
  next_sample_ = now + sample_span;
  const hw::sim::SkipMoment moment = rink.history().at(now);
  const vision::CameraSetup& far = *request_.rig.rig.far_camera;
  const vision::Pose eMc = hw::sim::true_far_pose(
      moment, robot_.scenario(), {.intrinsics = far.intrinsics, .mount = far.mount, .gamma = far.gamma}, robot_.axes());
  const servo::SkipDiagnosis& known = loop.skip().diagnosis();
  samples_.push_back({.t_s = seconds(now - *rink.released()),
                      .state = loop.skip().state(),
                      .truth = thrown.motion,
                      .on_ice = !thrown.taken_off,
                      .out = margins_[*rink.thrown()].back_m < 0.0 || margins_[*rink.thrown()].side_m < 0.0,
                      .off_axis_rad = off_axis(eMc, thrown.motion, request_.rig.skip.aiming.aim_height_m),
                      .pan_rad = moment.head.pan_rad,
                      .tilt_rad = moment.head.tilt_rad,
                      .known = known.thrown,
                      .covariance = known.thrown_covariance,
                      .stop = known.stop});
}

// A stone that is out can not come back.
void SkipRecord::follow_margins(const hw::sim::StoneField& field, std::vector<Margins>& margins) const {
  margins.resize(field.stones().size());
  const double radius = robot_.scenario().stone.radius_m;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    if (margins[i].back_m < 0.0 || margins[i].side_m < 0.0) continue;
    const hw::sim::StoneTruth& s = field.stones()[i].motion;
    margins[i].side_m = std::min(margins[i].side_m, 0.5 * robot_.scenario().sheet.width_m - std::abs(s.x_m) - radius);
    margins[i].back_m = std::min(margins[i].back_m, s.y_m + radius + servo::back_line_m);
  }
}

TrueStone SkipRecord::judged(const hw::sim::StoneField& field, std::size_t i, const Margins& m) const {
  const hw::sim::StoneTruth& end = field.stones()[i].motion;
  const bool thrown = robot_.rink().thrown() == i;
  const bool hit = std::any_of(field.contacts().begin(), field.contacts().end(), [&](const auto& c) {
    return c.striker == static_cast<int>(i) || c.struck == static_cast<int>(i);
  });
  const double hog = servo::hog_line_m - robot_.scenario().stone.radius_m - end.y_m;
  TrueStone stone{.start = thrown ? request_.scene.thrown : request_.scene.standing[i],
                  .end = end,
                  .fate = servo::StoneFate::at_rest,
                  .margin_m = std::min(std::abs(m.side_m), std::abs(m.back_m))};
  if (thrown && !hit) {
    stone.margin_m = std::min(stone.margin_m, std::abs(hog));
    if (hog < 0.0) stone.fate = servo::StoneFate::hogged;
  }
  // A stone that is out goes on being so: in doubt is only by which line it left, over a corner.
  if (m.back_m < 0.0) stone.fate = servo::StoneFate::through, stone.margin_m = std::max(0.0, m.side_m);
  if (m.side_m < 0.0) stone.fate = servo::StoneFate::sideline, stone.margin_m = std::max(0.0, m.back_m);
  return stone;
}

SkipOutcome SkipRecord::outcome(const SkipLoop& loop) const {
  hw::sim::StoneField field = robot_.rink().field();
  std::vector<Margins> margins = margins_;
  while (!field.at_rest()) {
    field.step(field.now() + std::chrono::milliseconds(5));
    follow_margins(field, margins);
  }
  SkipOutcome out;
  if (loop.skip().finished()) {
    out.report = loop.skip().report();
  } else {
    out.report.reason = "the simulation's time was over";
  }
  out.known = loop.skip().diagnosis();
  out.released = robot_.rink().released();
  out.samples = samples_;
  for (std::size_t i = 0; i < field.stones().size(); ++i) out.stones.push_back(judged(field, i, margins[i]));
  out.contacts = field.contacts();
  out.true_hog_to_hog_s = hog_to_hog_s_;
  out.passers = robot_.scenario().skip->passers;
  out.least_room_rad = robot_.rink().least_room_rad();
  out.near_frames = loop.near_frames();
  out.far_frames = loop.far_frames();
  out.simulated_s = seconds(robot_.rink().now() - robot_.rink().start());
  return out;
}

}  // namespace hogline
