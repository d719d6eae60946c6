#include <algorithm>
#include <cmath>
#include <utility>

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
constexpr int parts = 8;                  // of the picture, each searched by itself
constexpr int most_parts = 4;             // in one picture
constexpr double round_s = 0.27;          // all of them have had their turn
constexpr double refused_s = 0.7;         // for so long a place that is none is not asked again
constexpr double light_s = 0.25;          // lamps do not change faster, unless stones are lost,
constexpr double light_turn_rad = 0.008;  // nor does what a block of the picture shows of the ice
constexpr double most_speed_mps = 5.0;
constexpr double running_mps = 0.3;
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
  FarScan::Part part_due(Stamp stamp);
  FarSearch search(Stamp stamp, const std::vector<Predicted>& predicted, const FarArea& area);
  void note_refused(Stamp stamp, const std::vector<JudgedStone>& stones);
  void begin(const cv::Mat& image, Stamp stamp, const Pose& eMc, const FarArea& area);
  void remember(Stamp stamp, const std::vector<JudgedStone>& stones);
  void measure_handles(Stamp stamp, FarPercept& seen);

  FarView::Impl view;
  bool aimed = false;
  bool search_all = true;    ///< not only a part of the picture
  FarCorrection correction;  ///< of the last picture
  int part = 0;
  Stamp last{};  ///< picture's
  struct Refused {
    Eigen::Vector2d place;
    Stamp stamp{};
  };
  std::vector<Refused> refused;
  std::vector<Eigen::Vector2d> asked;  ///< in this picture, where nobody knew of a stone
  struct Lit {
    Pose eMc;
    Stamp stamp{};
  };
  std::optional<Lit> lit;  ///< when white ice was looked at last
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

// In pictures that come seldom more of it has its turn.
FarScan::Part FarSequence::Impl::part_due(Stamp stamp) {
  if (std::exchange(search_all, false)) return {};
  const int due = static_cast<int>(std::ceil(parts * seconds(stamp - last) / round_s - 1e-6));
  const FarScan::Part now{part, parts, std::clamp(due, 1, most_parts)};
  part = part + now.parts >= parts ? 0 : part + now.parts;
  return now;
}

FarSearch FarSequence::Impl::search(Stamp stamp, const std::vector<Predicted>& predicted, const FarArea& area) {
  FarSearch search;
  std::vector<FarPlace> taken;
  for (const Predicted& p : predicted) {
    taken.push_back(view.place_of(p.place));
    if (p.sure) {
      JudgedStone stone = p.known->seen;
      stone.candidate.place = stone.fit.place = p.place;
      stone.candidate.drift_m = drift_m(p.place, *view.levels[0].camera);
      search.stones.push_back(stone);
    } else {
      search.places.push_back(taken.back());
    }
  }
  std::erase_if(refused, [&](const Refused& r) { return seconds(stamp - r.stamp) > refused_s; });
  for (const Refused& r : refused) taken.push_back(view.place_of(r.place));
  const SheetCamera& camera = *view.levels.middle().camera;
  asked.clear();
  search.behind = search_all;  // such a picture takes its time, and there is all of it on each level
  for (const FarPlace& place : view.scan_part(area, part_due(stamp))) {
    const bool known_already = std::any_of(taken.begin(), taken.end(), [&](const FarPlace& other) {
      return std::abs(other.pixel.x - place.pixel.x) < other.half_width_px &&
             std::abs(other.pixel.y - place.pixel.y) < other.half_width_px;
    });
    if (known_already) continue;
    search.places.push_back(place);
    const auto on_ice = camera.plane_at({place.pixel.x, place.pixel.y}, view.setup.shape.handle_height_m);
    if (on_ice) asked.push_back(*on_ice);
  }
  return search;
}

// What was asked and is no stone is not asked again for a while.
void FarSequence::Impl::note_refused(Stamp stamp, const std::vector<JudgedStone>& stones) {
  for (const Eigen::Vector2d& place : asked) {
    const bool found = std::any_of(stones.begin(), stones.end(),
                                   [&](const JudgedStone& s) { return s.doubt.empty() && same(s.fit.place, place); });
    if (!found) refused.push_back({place, stamp});
  }
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
    lit.reset();  // it may be the light
    k.followed = false;
    next.push_back(k);
  }
  known = std::move(next);
  last = stamp;
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
    measure_turning_handle(picture, places, seen.stones[i]);
    handles_at = stamp;
  }
}

void FarSequence::Impl::begin(const cv::Mat& image, Stamp stamp, const Pose& eMc, const FarArea& area) {
  const bool holds = lit && !search_all && stamp > lit->stamp && seconds(stamp - lit->stamp) < light_s &&
                     Eigen::AngleAxisd(lit->eMc.linear().transpose() * eMc.linear()).angle() < light_turn_rad;
  if (holds) return view.go_on(image, eMc);
  view.begin(image, eMc, area);
  lit = Lit{eMc, stamp};
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
  begin(image, stamp, aimed_at.eMc, area);
  const std::vector<JudgedStone> stones = view.find_stones(search(stamp, predict(stamp, expected), area), area);

  view.report(stones, seen);
  note_refused(stamp, stones);
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
  impl_->refused.clear();
  impl_->lit.reset();
}

}  // namespace hogline::vision
