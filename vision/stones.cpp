#include "vision/stones.hpp"

#include <algorithm>
#include <cmath>

#include "vision/detect/granite.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {
namespace {

constexpr double behind_hog_m = 0.25;    // a stone that lies just outside is still ours to see
constexpr double behind_house_m = 0.60;  // behind the back line: out of play, but not yet taken away
constexpr double beside_m = 0.05;        // its centre beyond the sideline by more: a neighbour's
constexpr double least_granite = 0.20;   // of the body's front; a nearer stone's granite counts, too
constexpr double look_around_m = 0.15;
constexpr double same_place_m = 0.2;
constexpr int most_rounds = 3;    // a stone behind one behind one
constexpr double hiding_m = 1.2;  // a stone farther behind another is seen over it

StoneFitOptions quick_look() { return {.iterations = 2, .fit_shape = false, .pixels = 120}; }

// Something nearer stands in the way, or beside it.
bool may_be_hidden(const Eigen::Vector2d& place, const std::vector<NearerStone>& others, const Eigen::Vector2d& eye) {
  return std::any_of(others.begin(), others.end(), [&](const NearerStone& other) {
    const double apart_m = (other.place - place).norm();
    return (other.place - eye).norm() < (place - eye).norm() && apart_m < hiding_m && apart_m > same_place_m;
  });
}

// A stone stands there already.
bool is_taken(const Eigen::Vector2d& place, const std::vector<JudgedStone>& stones) {
  return std::any_of(stones.begin(), stones.end(), [&place](const JudgedStone& s) {
    return s.doubt.empty() && (s.fit.place - place).norm() < same_place_m;
  });
}

StoneFitOptions careful_look() { return {.iterations = 3, .fit_shape = false, .pixels = 200}; }

}  // namespace

struct StoneFinder::Impl {
  explicit Impl(const StonesSetup& stones_setup)
      : setup(stones_setup),
        lens(stones_setup.camera.intrinsics),
        response(stones_setup.camera.gamma),
        groups(stones_setup.camera, stones_setup.shape) {}

  std::string unusable(const cv::Mat& image) const;
  StoneArea area(std::optional<double> sheet_width_m) const;
  std::vector<JudgedStone> screen(const StonePicture& picture, const std::vector<StoneCandidate>& candidates);
  std::vector<NearerStone> look_behind(const StonePicture& picture, const std::vector<NearerStone>& known,
                                       const std::vector<NearerStone>& newest, std::vector<JudgedStone>& stones);
  void refine(const StonePicture& picture, std::vector<JudgedStone>& stones);
  StoneSighting sighting(const JudgedStone& stone) const;

  StonesSetup setup;
  Lens lens;
  ResponseCurve response;
  StoneGroupFinder groups;
  StoneVoter voter;
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
  const StoneArea area = impl_->area(sheet_width_m);

  const WhiteLight ice(image, impl_->response, impl_->groups.top());
  const StonePicture picture{image, impl_->response, ice, camera, impl_->setup.shape};
  const StoneGroups groups = impl_->groups.find(image, ice, impl_->response);
  const std::vector<StoneCandidate>& candidates =
      impl_->voter.find(picture, groups, {.area = area.wider(look_around_m)});

  std::vector<JudgedStone> stones = impl_->screen(picture, candidates);
  compare_granite(stones);
  part_overlapping(stones);
  doubt_grips(stones, picture.eye(), picture.shape);

  impl_->refine(picture, stones);
  compare_granite(stones);
  part_overlapping(stones);
  doubt_grips(stones, picture.eye(), picture.shape);

  for (JudgedStone& s : stones) {
    if (s.doubt.empty() && !area.contains(s.fit.place)) s.doubt = "not on this sheet";
    if (s.doubt.empty()) seen.stones.push_back(impl_->sighting(s));
    if (sketch != nullptr) sketch->candidates.push_back({s.candidate, s.fit, s.doubt});
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

// Where a stone of this sheet can lie: its centre between the sidelines. A stone that touches one is out, but ours.
StoneArea StoneFinder::Impl::area(std::optional<double> sheet_width_m) const {
  StoneArea area;
  area.half_width_m = 0.5 * sheet_width_m.value_or(rules::max_width_m) + beside_m;
  area.min_y_m = -rules::tee_to_back_m - behind_house_m;
  area.max_y_m = rules::tee_to_hog_m + behind_hog_m;
  return area;
}

// Each by itself: what is no stone does not look like one in any light. Then, those that something in front may hide:
// with the stones that are known by now left out of the picture.
std::vector<JudgedStone> StoneFinder::Impl::screen(const StonePicture& picture,
                                                   const std::vector<StoneCandidate>& candidates) {
  std::vector<JudgedStone> stones;
  for (const StoneCandidate& c : candidates) {
    if (is_taken(c.place, stones)) continue;
    if (granite_share(picture, c.place) < least_granite) {
      stones.push_back({c, FittedStone(), "no granite below the handle"});
      stones.back().fit.place = c.place;
      continue;
    }
    fitter.begin(picture, {c.place}, quick_look());
    if (is_hopeless(fitter.first_granite())) {
      stones.push_back({c, FittedStone(), "its colours are no stone's"});
      stones.back().fit.place = c.place;
      continue;
    }
    const FittedStone& fit = fitter.run().stones[0];
    stones.push_back({c, fit, doubt_of(c, fit, false)});
  }
  std::vector<NearerStone> known;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) known.push_back({s.fit.place, s.fit.handle});
  }
  std::vector<NearerStone> newest = known;
  for (int round = 0; round < most_rounds && !newest.empty(); ++round) {
    newest = look_behind(picture, known, newest, stones);
    known.insert(known.end(), newest.begin(), newest.end());
  }
  return stones;
}

// What may be hidden by the newest of the known stones is fitted again; those that turn out to be stones are returned.
std::vector<NearerStone> StoneFinder::Impl::look_behind(const StonePicture& picture,
                                                        const std::vector<NearerStone>& known,
                                                        const std::vector<NearerStone>& newest,
                                                        std::vector<JudgedStone>& stones) {
  StoneFitOptions options = careful_look();
  options.nearer = known;
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<NearerStone> found;
  for (JudgedStone& s : stones) {
    if (s.doubt.empty() || is_taken(s.candidate.place, stones)) continue;
    if (!may_be_hidden(s.candidate.place, newest, eye)) continue;
    fitter.begin(picture, {s.candidate.place}, options);
    s.fit = fitter.run().stones[0];
    s.doubt = doubt_of(s.candidate, s.fit, true);
    if (s.doubt.empty()) found.push_back({s.fit.place, s.fit.handle});
  }
  return found;
}

// All together: stones that hide each other, and the shape they share.
void StoneFinder::Impl::refine(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  std::vector<Eigen::Vector2d> starts;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) starts.push_back(s.fit.place);
  }
  fitter.begin(picture, starts, {});
  const StoneFitResult& result = fitter.run();
  std::size_t next = 0;
  std::vector<NearerStone> others;
  for (const FittedStone& f : result.stones) others.push_back({f.place, f.handle});
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    s.fit = result.stones[next++];
    s.doubt = doubt_of(s.candidate, s.fit, may_be_hidden(s.fit.place, others, picture.eye().head<2>()));
  }
}

StoneSighting StoneFinder::Impl::sighting(const JudgedStone& stone) const {
  StoneSighting s;
  s.x_m = stone.fit.place.x();
  s.y_m = stone.fit.place.y();
  s.covariance = {stone.fit.covariance(0, 0), stone.fit.covariance(0, 1), stone.fit.covariance(1, 1)};
  s.colour = {static_cast<float>(stone.fit.handle[2]), static_cast<float>(stone.fit.handle[1]),
              static_cast<float>(stone.fit.handle[0])};
  const TeamVerdict team = team_of(s.colour, setup.teams);
  s.team = team.team;
  s.team_confidence = team.confidence;
  s.support = stone.candidate.votes;
  s.visible = stone.fit.visible;
  s.residual = stone.fit.residual;
  return s;
}

}  // namespace hogline::vision
