#include "vision/stones.hpp"

#include <algorithm>
#include <cmath>

#include "vision/crowd_screening.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/handle_angle.hpp"
#include "vision/picture/picture_shape.hpp"
#include "vision/picture_clarity.hpp"
#include "vision/stone_looks.hpp"
#include "vision/stone_surroundings.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {
namespace {

constexpr double behind_hog_m = 0.25;    // a stone that lies just outside is still ours to see
constexpr double behind_house_m = 0.60;  // behind the back line: out of play, but not yet taken away
constexpr double beside_m = 0.05;        // its centre beyond the sideline by more: a neighbour's
constexpr double into_bumper_m = 0.10;   // so far a stone seems to stand in one
constexpr double look_around_m = 0.15;
constexpr double alike = 0.15;  // of the light's difference from ice
constexpr int most_settlings = 2;
constexpr double made_way_m = 0.30;

std::vector<Eigen::Vector2d> places_of(const std::vector<JudgedStone>& stones) {
  std::vector<Eigen::Vector2d> places;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) places.push_back(s.fit.place);
  }
  return places;
}

/// What stands on the ice ends at its foot and at its grip. Seen from above, paint below a stone of its own colour is
/// not rare, and somebody may stand behind one: both together are a person.
std::string doubt_of_a_person(const StonePicture& picture, const JudgedStone& stone,
                              const std::vector<Eigen::Vector2d>& places) {
  std::vector<KnownStone> nearer;
  for (const Eigen::Vector2d& p : places) nearer.push_back({p});
  const StoneSurroundings around = surroundings_of(picture, stone, nearer, alike);
  return around.granite_below && around.handle_above ? "it goes on below the foot and above the grip" : std::string();
}

}  // namespace

/// What all of them together have left of the stones.
struct Settling {
  std::vector<StoneSighting> stones;
  std::vector<StoneCandidate> again;  ///< that fell, and those that had to make way for them
};

namespace {

// A fit from other places, with the rest known, may yet find a stone; somebody who goes on or paint stays what it is.
std::vector<StoneCandidate> to_be_looked_at(const std::vector<JudgedStone>& stones, const std::vector<bool>& believed,
                                            const std::vector<bool>& refused_for_good) {
  std::vector<StoneCandidate> again;
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (!believed[i] || stones[i].doubt.empty()) continue;
    if (!refused_for_good[i]) again.push_back(stones[i].candidate);
    for (std::size_t j = 0; j < stones.size(); ++j) {
      const bool made_way = !believed[j] && stones[j].doubt == no_room;
      if (made_way && (stones[j].fit.place - stones[i].fit.place).norm() < made_way_m) {
        again.push_back(stones[j].candidate);
      }
    }
  }
  return again;
}

std::vector<bool> believed_of(const std::vector<JudgedStone>& stones) {
  std::vector<bool> believed;
  for (const JudgedStone& s : stones) believed.push_back(s.doubt.empty());
  return believed;
}

}  // namespace

struct StoneFinder::Impl {
  explicit Impl(const StonesSetup& stones_setup)
      : setup(stones_setup),
        lens(stones_setup.camera.intrinsics),
        response(stones_setup.camera.gamma),
        groups(stones_setup.camera, stones_setup.shape),
        screening(stones_setup.teams) {}

  Settling settle(const StonePicture& picture, const StoneArea& area, std::vector<JudgedStone>& stones);

  StonesSetup setup;
  Lens lens;
  ResponseCurve response;
  StoneGroupFinder groups;
  StoneVoter voter;
  CrowdScreening screening;
  StoneFitter fitter;
};

StoneFinder::StoneFinder(const StonesSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
StoneFinder::~StoneFinder() = default;
StoneFinder::StoneFinder(StoneFinder&&) noexcept = default;
StoneFinder& StoneFinder::operator=(StoneFinder&&) noexcept = default;

StonesPercept StoneFinder::find(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m,
                                StonesSketch* sketch) {
  StonesPercept seen;
  seen.stamp = stamp;
  seen.reason = shape_fault(image, impl_->lens.intrinsics());
  if (!seen.reason.empty()) return seen;
  const SheetCamera camera(impl_->lens, eMc, impl_->setup.camera.ice);
  const StoneArea area = stone_area(sheet_width_m, impl_->setup.camera.sheet.sideline);

  const WhiteLight ice(image, impl_->response, impl_->groups.top());
  const PictureClarity clarity = clarity_of(image, impl_->response, ice, camera);
  seen.blur_px = clarity.blur_px;
  seen.noise = clarity.noise;
  seen.reason = clarity.fault();
  if (!seen.reason.empty()) return seen;
  const StonePicture picture{image, impl_->response, ice, camera, impl_->setup.shape};
  const StoneGroups groups = impl_->groups.find(image, ice, impl_->response);
  const std::vector<StoneCandidate>& candidates =
      impl_->voter.find(picture, groups, {.area = area.wider(look_around_m), .also_faint = true});

  std::vector<JudgedStone> stones = impl_->screening.look(picture, candidates);
  compare_granite(stones);
  impl_->screening.tell_apart(picture, stones);
  part_overlapping(picture, stones);
  impl_->screening.look_again(picture, stones);
  impl_->screening.place_again(picture, stones);
  part_overlapping(picture, stones);

  Settling settled = impl_->settle(picture, area, stones);
  for (int round = 1; round < most_settlings && !settled.again.empty(); ++round) {
    impl_->screening.look_at(picture, settled.again, stones);
    part_overlapping(picture, stones);
    settled = impl_->settle(picture, area, stones);
  }

  seen.stones = settled.stones;
  for (const JudgedStone& s : stones) {
    if (sketch != nullptr) sketch->candidates.push_back({s.candidate, s.fit, s.doubt, s.glimpsed, s.before});
  }
  if (sketch != nullptr) sketch->boxes = groups.boxes;
  seen.ok = true;
  seen.groups = static_cast<int>(groups.boxes.size());
  seen.candidates = static_cast<int>(stones.size());
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
  return seen;
}

StoneGroupFinder& StoneFinder::groups() { return impl_->groups; }

// On a bumper, red or blue and a hand high, somebody's foot may look like a stone.
StoneArea stone_area(std::optional<double> sheet_width_m, SidelineKind sideline) {
  StoneArea area;
  const double beyond_m = sideline == SidelineKind::bumper ? into_bumper_m - rules::stone_radius_m : beside_m;
  area.half_width_m = 0.5 * sheet_width_m.value_or(rules::max_width_m) + beyond_m;
  area.min_y_m = -rules::tee_to_back_m - behind_house_m;
  area.max_y_m = rules::tee_to_hog_m + behind_hog_m;
  return area;
}

// The grip belongs to a stone: what is painted on the ice, for whatever eye, has nothing over its rim.
std::string last_doubt(const StonePicture& picture, const JudgedStone& stone,
                       const std::vector<Eigen::Vector2d>& places, StoneSighting& sighting) {
  const std::string person = doubt_of_a_person(picture, stone, places);
  if (!person.empty()) return person;
  const HandleAngle handle = handle_angle(picture, sighting, places);
  if (handle.present < least_grip_of(stone)) return "no grip over the plate";
  if (handle.ok) {
    sighting.handle_rad = handle.rad;
    sighting.handle_sigma_rad = handle.sigma_rad;
  }
  return {};
}

Settling StoneFinder::Impl::settle(const StonePicture& picture, const StoneArea& area,
                                   std::vector<JudgedStone>& stones) {
  const std::vector<bool> believed = believed_of(stones);
  fit_together(picture, {}, without_doubt(stones), fitter);
  compare_granite(stones);
  part_overlapping(picture, stones);
  const std::vector<Eigen::Vector2d> places = places_of(stones);
  std::vector<bool> for_good(stones.size(), false);
  Settling settled;
  for (std::size_t i = 0; i < stones.size(); ++i) {
    JudgedStone& s = stones[i];
    if (!s.doubt.empty()) continue;
    if (!area.contains(s.fit.place)) s.doubt = "not on this sheet";
    StoneSighting sighting = sighting_of(s, setup.teams);
    if (s.doubt.empty()) s.doubt = last_doubt(picture, s, places, sighting);
    if (s.doubt.empty()) settled.stones.push_back(sighting);
    for_good[i] = !s.doubt.empty();
  }
  settled.again = to_be_looked_at(stones, believed, for_good);
  return settled;
}

}  // namespace hogline::vision
