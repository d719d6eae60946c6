#include "vision/stones.hpp"

#include <algorithm>
#include <cmath>

#include "vision/crowd_screening.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/handle_angle.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {
namespace {

constexpr double behind_hog_m = 0.25;    // a stone that lies just outside is still ours to see
constexpr double behind_house_m = 0.60;  // behind the back line: out of play, but not yet taken away
constexpr double beside_m = 0.05;        // its centre beyond the sideline by more: a neighbour's
constexpr double look_around_m = 0.15;

}  // namespace

struct StoneFinder::Impl {
  explicit Impl(const StonesSetup& stones_setup)
      : setup(stones_setup),
        lens(stones_setup.camera.intrinsics),
        response(stones_setup.camera.gamma),
        groups(stones_setup.camera, stones_setup.shape),
        screening(stones_setup.teams) {}

  std::string unusable(const cv::Mat& image) const;
  void refine(const StonePicture& picture, std::vector<JudgedStone>& stones);

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
  seen.reason = impl_->unusable(image);
  if (!seen.reason.empty()) return seen;
  const SheetCamera camera(impl_->lens, eMc, impl_->setup.camera.ice);
  const StoneArea area = stone_area(sheet_width_m);

  const WhiteLight ice(image, impl_->response, impl_->groups.top());
  const StonePicture picture{image, impl_->response, ice, camera, impl_->setup.shape};
  const StoneGroups groups = impl_->groups.find(image, ice, impl_->response);
  const std::vector<StoneCandidate>& candidates =
      impl_->voter.find(picture, groups, {.area = area.wider(look_around_m)});

  std::vector<JudgedStone> stones = impl_->screening.look(picture, candidates);
  compare_granite(stones);
  impl_->screening.tell_apart(picture, stones);
  part_overlapping(picture, stones);
  impl_->screening.look_again(picture, stones);
  part_overlapping(picture, stones);

  impl_->refine(picture, stones);
  compare_granite(stones);
  part_overlapping(picture, stones);

  std::vector<Eigen::Vector2d> places;
  for (JudgedStone& s : stones) {
    if (s.doubt.empty()) places.push_back(s.fit.place);
    if (s.doubt.empty() && !area.contains(s.fit.place)) s.doubt = "not on this sheet";
    if (s.doubt.empty()) seen.stones.push_back(sighting_of(s, impl_->setup.teams));
    if (sketch != nullptr) sketch->candidates.push_back({s.candidate, s.fit, s.doubt, s.glimpsed});
  }
  for (StoneSighting& s : seen.stones) measure_handle(picture, places, s);
  if (sketch != nullptr) sketch->boxes = groups.boxes;
  seen.ok = true;
  seen.groups = static_cast<int>(groups.boxes.size());
  seen.candidates = static_cast<int>(stones.size());
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
  return seen;
}

std::string StoneFinder::Impl::unusable(const cv::Mat& image) const {
  if (image.empty()) return "the picture is empty";
  if (image.type() != CV_8UC3) return "the picture is not 8 bits a channel in three colours";
  const Intrinsics& k = lens.intrinsics();
  if (image.cols != k.width_px || image.rows != k.height_px) {
    return "the picture is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", the rig's camera " +
           std::to_string(k.width_px) + "x" + std::to_string(k.height_px);
  }
  return {};
}

StoneGroupFinder& StoneFinder::groups() { return impl_->groups; }

StoneArea stone_area(std::optional<double> sheet_width_m) {
  StoneArea area;
  area.half_width_m = 0.5 * sheet_width_m.value_or(rules::max_width_m) + beside_m;
  area.min_y_m = -rules::tee_to_back_m - behind_house_m;
  area.max_y_m = rules::tee_to_hog_m + behind_hog_m;
  return area;
}

// All together: stones that hide each other, and the shape they share.
void StoneFinder::Impl::refine(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  const auto granite = clubs_granite(stones);
  std::vector<StoneStart> starts;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) starts.push_back({s.fit.place, s.glimpsed ? granite : std::nullopt});
  }
  fitter.begin(picture, starts, {});
  const StoneFitResult& result = fitter.run();
  std::size_t next = 0;
  std::vector<NearerStone> others;
  for (const FittedStone& f : result.stones) others.push_back({f.place, f.handle});
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    s.fit = result.stones[next++];
    s.doubt = s.glimpsed && granite
                  ? doubt_of_glimpse(s.candidate, s.fit, *granite)
                  : doubt_of(s.candidate, s.fit, may_be_hidden(s.fit.place, others, picture.eye().head<2>()));
  }
}

}  // namespace hogline::vision
