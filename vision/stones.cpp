#include "vision/stones.hpp"

#include <cmath>

#include "vision/detect/ice_light.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_vote.hpp"

namespace hogline::vision {

struct StoneFinder::Impl {
  explicit Impl(const StonesSetup& stones_setup)
      : setup(stones_setup),
        lens(stones_setup.camera.intrinsics),
        response(stones_setup.camera.gamma),
        groups(stones_setup.camera, stones_setup.shape) {}

  std::string unusable(const cv::Mat& image) const;

  StonesSetup setup;
  Lens lens;
  ResponseCurve response;
  StoneGroupFinder groups;
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

  const IceLight ice(image, impl_->response, impl_->groups.top());
  const StoneGroups groups = impl_->groups.find(image, ice, impl_->response);
  const auto candidates = vote_for_stones(image, groups, ice, impl_->response, camera, impl_->setup.shape);

  const double half_width_m = 0.5 * sheet_width_m.value_or(rules::max_width_m);
  for (const StoneCandidate& c : candidates) {
    std::string verdict;
    if (std::abs(c.place.x()) > half_width_m + 0.15) verdict = "beyond the sideline";
    if (c.place.y() > rules::tee_to_hog_m + 0.3) verdict = "beyond the hog line";
    if (c.votes < 0.5) verdict = "few votes";
    const auto colour = handle_colour(image, c.place, camera, impl_->setup.shape, ice, impl_->response);
    if (!colour) verdict = "no colour";
    if (sketch != nullptr) {
      sketch->candidates.push_back({c.place.x(), c.place.y(), c.votes, c.handle_votes, c.body_votes, verdict});
    }
    if (!verdict.empty()) continue;
    StoneSighting stone;
    stone.x_m = c.place.x();
    stone.y_m = c.place.y();
    stone.colour = *colour;
    const TeamVerdict team = team_of(*colour, impl_->setup.teams);
    stone.team = team.team;
    stone.team_confidence = team.confidence;
    stone.support = c.votes;
    seen.stones.push_back(stone);
  }
  if (sketch != nullptr) sketch->boxes = groups.boxes;
  seen.ok = true;
  seen.groups = static_cast<int>(groups.boxes.size());
  seen.candidates = static_cast<int>(candidates.size());
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

}  // namespace hogline::vision
