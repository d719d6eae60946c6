#include "vision/stone_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "vision/handle_angle.hpp"
#include "vision/stone_sequence_impl.hpp"

namespace hogline::vision {
namespace {

constexpr double pitch_step_rad = 0.026;  // 1.5 deg: what size stones have in a row is worked out once for each
constexpr double longest_gap_s = 1.0;
constexpr int most_parts = 4;    // in one picture
constexpr double round_s = 0.2;  // all of them have had their turn

double pitch_of(const Pose& eMc) { return std::asin(std::clamp(-eMc.linear()(2, 2), -1.0, 1.0)); }

}  // namespace

StoneFinder& StoneSequence::Impl::finder(const Pose& eMc) {
  const int step = static_cast<int>(std::lround(pitch_of(eMc) / pitch_step_rad));
  const auto made = finders.find(step);
  if (made != finders.end()) return made->second;
  StonesSetup held = setup;
  held.camera.mount = {.z_m = eMc.translation().z(), .pitch_rad = step * pitch_step_rad};
  return finders.emplace(step, held).first->second;
}

StonesPercept StoneSequence::Impl::look(const cv::Mat& image, Stamp stamp, const Pose& eMc,
                                        std::optional<double> sheet_width_m,
                                        const std::vector<StoneExpectation>& expected) {
  diagnosis = {};
  const Intrinsics& k = lens.intrinsics();
  const bool usable = image.type() == CV_8UC3 && image.cols == k.width_px && image.rows == k.height_px;
  if (!usable) return finder(eMc).find(image, stamp, eMc, sheet_width_m);  // says why
  const bool follows = last && stamp > *last && seconds(stamp - *last) < longest_gap_s;
  if (!follows) return look_at_all(image, stamp, eMc, sheet_width_m);

  StoneGroupFinder& groups = finder(eMc).groups();
  const SheetCamera camera(lens, eMc, setup.camera.ice);
  const StonePicture picture{image, response, light(image, eMc, groups.top(), stamp), camera, setup.shape};
  const StoneArea area = stone_area(sheet_width_m, setup.camera.sheet.sideline);

  std::vector<StoneExpectation> unknown;
  const std::vector<Foretold> foretold = foretell(stamp, expected, camera, unknown);
  Scene scene;
  follow(picture, foretold, true, scene);
  follow(picture, foretold, false, scene);

  std::vector<Foretold> missing;
  for (const Foretold& f : foretold) {
    const bool found =
        std::any_of(scene.known.begin(), scene.known.end(), [&](const auto& id) { return id == f.known; });
    if (!found && (known[f.known].in_sight || !f.sure)) missing.push_back(f);
  }
  diagnosis.followed = static_cast<int>(scene.stones.size());
  diagnosis.lost = static_cast<int>(missing.size());
  const std::size_t first_new = scene.stones.size();
  forget_refused(stamp);
  const int due = static_cast<int>(std::ceil(parts * seconds(stamp - *last) / round_s));
  StoneGroups places = unexplained(picture, groups, std::clamp(due, 1, most_parts), scene);
  search(picture, places, missing, unknown, area, scene);
  if (scene.stones.size() > first_new) settle(picture, missing, first_new, scene);
  compare_granite(scene.stones);
  part_overlapping(picture, scene.stones);

  if (diagnosis.followed == 0 || diagnosis.lost > 0) lit.reset();  // it may be the light
  remember(stamp, scene);
  return report(picture, area, stamp, scene);
}

StonesPercept StoneSequence::Impl::look_at_all(const cv::Mat& image, Stamp stamp, const Pose& eMc,
                                               std::optional<double> sheet_width_m) {
  diagnosis.whole = true;
  StonesSketch sketch;
  const StonesPercept seen = finder(eMc).find(image, stamp, eMc, sheet_width_m, &sketch);
  known.clear();
  shared.reset();
  last.reset();
  if (!seen.ok) return seen;
  for (const StonesSketch::Candidate& c : sketch.candidates) {
    if (c.doubt.empty()) known.push_back({{c.votes, c.fit, {}, c.glimpsed, c.before}, stamp});
  }
  last = stamp;
  return seen;
}

// After remember(). A handle's direction is asked of stones that run: it tells how they turn.
StonesPercept StoneSequence::Impl::report(const StonePicture& picture, const StoneArea& area, Stamp stamp,
                                          const Scene& scene) const {
  StonesPercept seen;
  seen.ok = true;
  seen.stamp = stamp;
  std::vector<Eigen::Vector2d> places;
  for (const KnownStone& s : scene.believed()) places.push_back(s.place);
  for (const Known& k : known) {
    if (!k.in_sight || !area.contains(k.seen.fit.place)) continue;
    seen.stones.push_back(sighting_of(k.seen, setup.teams));
    if (!k.velocity.isZero()) measure_turning_handle(picture, places, seen.stones.back());
  }
  seen.candidates = static_cast<int>(scene.stones.size());
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
  return seen;
}

StoneSequence::StoneSequence(const StonesSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
StoneSequence::~StoneSequence() = default;
StoneSequence::StoneSequence(StoneSequence&&) noexcept = default;
StoneSequence& StoneSequence::operator=(StoneSequence&&) noexcept = default;

StonesPercept StoneSequence::look(const cv::Mat& image, Stamp stamp, const Pose& eMc,
                                  std::optional<double> sheet_width_m, const std::vector<StoneExpectation>& expected) {
  return impl_->look(image, stamp, eMc, sheet_width_m, expected);
}

void StoneSequence::forget() {
  impl_->known.clear();
  impl_->refused.clear();
  impl_->asked.release();
  impl_->lit.reset();
  impl_->last.reset();
  impl_->part = impl_->round = 0;
}

const StoneSequenceDiagnosis& StoneSequence::diagnosis() const { return impl_->diagnosis; }

StoneFinder& StoneSequence::finder(const Pose& eMc) { return impl_->finder(eMc); }

}  // namespace hogline::vision
