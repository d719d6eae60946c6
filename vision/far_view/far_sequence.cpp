#include <algorithm>
#include <cmath>

#include "vision/far_view/far_view_impl.hpp"
#include "vision/handle_angle.hpp"

namespace hogline::vision {
namespace {

// What may change from picture to picture beside what the plan knows: drives that swing, a head that bends.
constexpr double changed_turn_rad = 3.5e-4;  // 0.02 deg, two pixels of the longest lens
constexpr double remembered_s = 1.0;         // a stone that is not seen again for so long is found anew
constexpr double same_stone_m = 0.35;
constexpr double along_per_across = 3.0;  // by which places are less sure along the line of sight
constexpr double sure_px = 1.5;           // a prediction better than this needs no votes
constexpr int parts = 4;                  // the picture is searched in so many pictures
constexpr double most_speed_mps = 5.0;
constexpr double running_mps = 0.3;
constexpr double handle_range_m = 26.0;   // farther away a grip is a few pixels high, and seen nearly from the side
constexpr double handle_period_s = 0.06;  // a stone turns by a tenth of a turn in it

}  // namespace

struct FarSequence::Impl {
  /// A stone as it was last seen.
  struct Known {
    JudgedStone seen;
    Stamp stamp{};
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    bool followed = false;  ///< it was seen in the last picture and in the one before: its velocity is known
  };
  /// Where a stone should be now.
  struct Predicted {
    const Known* known = nullptr;
    Eigen::Vector2d place;
    bool sure = false;
  };

  explicit Impl(const FarSetup& setup) : view(setup, quick_screening()) {}

  FarPercept look(const cv::Mat& image, Stamp stamp, const FarPlan& plan,
                  const std::vector<StoneExpectation>& expected);
  const FarAim& aim(const PictureLight& light, const FarPlan& plan);
  bool same(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  bool sure(const StoneExpectation& expectation) const;
  std::vector<Predicted> predict(Stamp stamp, const std::vector<StoneExpectation>& expected) const;
  FarSearch search(const std::vector<Predicted>& predicted, const FarArea& area);
  void remember(Stamp stamp, const std::vector<JudgedStone>& stones);
  void measure_handles(Stamp stamp, FarPercept& seen);
  FarPlace place_of(const Eigen::Vector2d& place) const;

  FarView::Impl view;
  bool aimed = false;
  bool search_all = true;    ///< not only a part of the picture
  FarCorrection correction;  ///< of the last picture
  int part = 0;
  std::vector<Known> known;
  Stamp handles_at{};  ///< when handles' directions were asked for last
};

// The last picture's correction is the plan's, unless the sheet has gone from there: then it is looked for anew.
const FarAim& FarSequence::Impl::aim(const PictureLight& light, const FarPlan& plan) {
  if (aimed) {
    FarPlan next = plan;
    next.eMc = corrected(plan.eMc, correction);
    next.pan_sigma_rad = std::hypot(correction.pan_sigma_rad, changed_turn_rad);
    next.tilt_sigma_rad = std::hypot(correction.tilt_sigma_rad, changed_turn_rad);
    next.roll_sigma_rad = std::hypot(correction.roll_sigma_rad, changed_turn_rad);
    const FarAim& followed = view.sheet.follow(light, next);
    if (followed.ok) {
      correction.pan_rad += followed.correction.pan_rad;
      correction.tilt_rad += followed.correction.tilt_rad;
      correction.roll_rad += followed.correction.roll_rad;
      correction.pan_sigma_rad = followed.correction.pan_sigma_rad;
      correction.tilt_sigma_rad = followed.correction.tilt_sigma_rad;
      correction.roll_sigma_rad = followed.correction.roll_sigma_rad;
      return followed;
    }
  }
  const FarAim& found = view.sheet.find(light, plan);
  aimed = found.ok;
  search_all = true;
  correction = found.correction;
  return found;
}

// Places are less sure along the line of sight, which is nearly e's y axis.
bool FarSequence::Impl::same(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  return std::hypot(a.x() - b.x(), (a.y() - b.y()) / along_per_across) < same_stone_m;
}

bool FarSequence::Impl::sure(const StoneExpectation& expectation) const {
  const SheetCamera& camera = *view.levels.middle().camera;
  const Eigen::Vector3d eye = camera.eMc().translation();
  const double range_m = std::hypot(expectation.x_m - eye.x(), expectation.y_m - eye.y());
  const double px_per_m = camera.lens().intrinsics().fy_px * eye.z() / (range_m * range_m);
  const double across_px_per_m = camera.lens().intrinsics().fx_px / range_m;
  return std::sqrt(expectation.covariance.yy_m2) * px_per_m < sure_px &&
         std::sqrt(expectation.covariance.xx_m2) * across_px_per_m < sure_px;
}

// By its own motion; a tracker knows better. What only the tracker knows of is looked for by votes.
std::vector<FarSequence::Impl::Predicted> FarSequence::Impl::predict(
    Stamp stamp, const std::vector<StoneExpectation>& expected) const {
  std::vector<Predicted> all;
  for (const Known& k : known) {
    const double dt_s = seconds(stamp - k.stamp);
    all.push_back({&k, k.seen.fit.place + dt_s * k.velocity, k.followed});
  }
  for (const StoneExpectation& e : expected) {
    const Eigen::Vector2d place(e.x_m, e.y_m);
    const auto nearest = std::min_element(all.begin(), all.end(), [&](const Predicted& a, const Predicted& b) {
      return (a.place - place).norm() < (b.place - place).norm();
    });
    if (nearest == all.end() || !same(nearest->place, place)) {
      all.push_back({nullptr, place, false});
    } else if (sure(e)) {
      nearest->place = place;
      nearest->sure = nearest->known != nullptr;
    }
  }
  return all;
}

FarPlace FarSequence::Impl::place_of(const Eigen::Vector2d& place) const {
  const SheetCamera& camera = *view.levels.middle().camera;
  const Eigen::Vector3d eye = camera.eMc().translation();
  FarPlace p;
  p.range_m = (place - eye.head<2>()).norm();
  const auto pixel = camera.project({place.x(), place.y(), view.setup.shape.handle_height_m});
  p.pixel = pixel ? cv::Point2d(pixel->x(), pixel->y()) : cv::Point2d(-1e3, -1e3);
  p.half_width_px = view.setup.shape.body_radius_m * camera.lens().intrinsics().fx_px / std::max(1.0, p.range_m);
  return p;
}

FarSearch FarSequence::Impl::search(const std::vector<Predicted>& predicted, const FarArea& area) {
  FarSearch search;
  for (const Predicted& p : predicted) {
    if (p.sure) {
      JudgedStone stone = p.known->seen;
      stone.candidate.place = stone.fit.place = p.place;
      stone.candidate.drift_m = drift_m(p.place, *view.levels[0].camera);
      search.stones.push_back(stone);
    } else {
      search.places.push_back(place_of(p.place));
    }
  }
  const FarScan::Part now = search_all ? FarScan::Part{} : FarScan::Part{part, parts};
  search_all = false;
  for (const FarPlace& place : view.scan_part(area, now)) {
    const bool taken = std::any_of(predicted.begin(), predicted.end(), [&](const Predicted& p) {
      const FarPlace other = place_of(p.place);
      return std::abs(other.pixel.x - place.pixel.x) < other.half_width_px &&
             std::abs(other.pixel.y - place.pixel.y) < other.half_width_px;
    });
    if (!taken) search.places.push_back(place);
  }
  part = (part + 1) % parts;
  return search;
}

void FarSequence::Impl::remember(Stamp stamp, const std::vector<JudgedStone>& stones) {
  std::vector<Known> next;
  for (const JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    Known now{s, stamp};
    for (const Known& k : known) {
      const double dt_s = seconds(stamp - k.stamp);
      if (!(dt_s > 0.0) || !same(k.seen.fit.place + dt_s * k.velocity, s.fit.place)) continue;
      const Eigen::Vector2d velocity = (s.fit.place - k.seen.fit.place) / dt_s;
      now.followed = velocity.norm() < most_speed_mps;
      if (!now.followed) continue;
      // A place's own noise is no motion: a little of it each time.
      now.velocity = k.followed ? Eigen::Vector2d(k.velocity + 0.4 * (velocity - k.velocity)) : velocity;
      break;
    }
    next.push_back(now);
  }
  for (Known& k : known) {
    const bool again = std::any_of(next.begin(), next.end(), [&](const Known& n) {
      return same(n.seen.fit.place, k.seen.fit.place + seconds(n.stamp - k.stamp) * k.velocity);
    });
    if (again || seconds(stamp - k.stamp) > remembered_s) continue;
    k.followed = false;
    next.push_back(k);
  }
  known = std::move(next);
}

// Of what runs: it tells how it turns. In the whole picture, where a grip is largest.
void FarSequence::Impl::measure_handles(Stamp stamp, FarPercept& seen) {
  if (seconds(stamp - handles_at) < handle_period_s && stamp >= handles_at) return;
  const StonePicture picture = view.levels[0].picture(view.response, view.setup.shape);
  std::vector<Eigen::Vector2d> places;
  for (const StoneSighting& s : seen.stones) places.emplace_back(s.x_m, s.y_m);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool near_enough = (places[i] - picture.eye().head<2>()).norm() < handle_range_m;
    const bool runs = std::any_of(known.begin(), known.end(), [&](const Known& k) {
      return k.stamp == stamp && k.followed && k.velocity.norm() > running_mps && k.seen.fit.place == places[i];
    });
    if (!near_enough || !runs) continue;
    measure_handle(picture, places, seen.stones[i]);
    handles_at = stamp;
  }
}

FarPercept FarSequence::Impl::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan,
                                   const std::vector<StoneExpectation>& expected) {
  FarPercept seen;
  seen.stamp = stamp;
  seen.reason = unusable(image, view.setup.camera.intrinsics, plan);
  if (!seen.reason.empty()) return seen;

  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, view.response};
  const FarAim& aimed_at = aim(light, plan);
  if (!aimed_at.ok) {
    seen.reason = "how the camera looks: " + aimed_at.reason;
    return seen;
  }
  report_aim(aimed_at, seen);
  seen.correction = correction;

  const FarArea area = view.area_of(aimed_at, plan);
  view.begin(image, aimed_at.eMc, area);
  const std::vector<JudgedStone> stones = view.find_stones(search(predict(stamp, expected), area), area);

  view.report(stones, seen);
  remember(stamp, stones);
  measure_handles(stamp, seen);
  return seen;
}

FarSequence::FarSequence(const FarSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
FarSequence::~FarSequence() = default;
FarSequence::FarSequence(FarSequence&&) noexcept = default;
FarSequence& FarSequence::operator=(FarSequence&&) noexcept = default;

FarPercept FarSequence::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan,
                             const std::vector<StoneExpectation>& expected) {
  return impl_->look(image, stamp, plan, expected);
}

void FarSequence::forget() {
  impl_->aimed = false;
  impl_->part = 0;
  impl_->known.clear();
}

}  // namespace hogline::vision
