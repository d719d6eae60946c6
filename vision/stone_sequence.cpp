#include "vision/stone_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/crowd_screening.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/handle_angle.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {
namespace {

constexpr double pitch_step_rad = 0.026;  // 1.5 deg: what size stones have in a row is worked out once for each
constexpr double longest_gap_s = 1.0;
constexpr double remembered_s = 1.0;            // of a stone that runs
constexpr double remembered_standing_s = 30.0;  // somebody may stand before it
constexpr int parts = 8;                        // of the picture, each searched by itself
constexpr int most_parts = 4;                   // in one picture
constexpr double round_s = 0.2;                 // all of them have had their turn
constexpr int asked_again = 4;                  // rounds after which what was no stone is asked again
constexpr int same_mark_px = 6;                 // of half the picture's size
constexpr double refused_s = 1.0;               // for so long a place that is none is not asked again
constexpr double refused_m = 0.12;
constexpr double light_s = 0.25;          // lamps do not change faster,
constexpr double light_turn_rad = 0.015;  // nor does what a block of the picture shows of the ice

constexpr double same_stone_m = 0.16;  // touching ones are 0.29 m apart
constexpr double taken_m = 0.2;        // no other stone's centre lies so near
constexpr double sure_px = 1.5;        // a prediction better than this needs no votes
constexpr double close_px = 0.7;       // a fit that ends farther from where it began may not be at its end
constexpr double astray_px = 3.0;      // nor may one be believed that began so far off: votes are asked
constexpr double told_less = 0.12;     // than in the last picture: it may be another's edge
constexpr double explained_less = 0.06;
constexpr double moved_sigmas = 4.0;  // of a place's own noise
constexpr double least_moved_m = 0.004;
constexpr double velocity_share = 0.4;  // of what is new, each time
constexpr double most_speed_mps = 4.5;
constexpr double struck_mps = 2.5;  // how fast a stone may be that was struck since the last picture
constexpr double least_reach_m = 0.15;
constexpr double most_reach_m = 0.8;
constexpr double look_around_m = 0.15;
constexpr double silhouette = 1.25;  // with the shadow about the foot

StoneFitOptions follow_fit(const std::optional<SharedLook>& look) {
  return {.iterations = look ? 2 : 4, .pixels = 110, .nearer = {}, .begin_with = look};
}
StoneFitOptions found_fit(const std::optional<SharedLook>& look) {
  return {.iterations = 3, .pixels = 200, .nearer = {}, .begin_with = look};
}

}  // namespace

struct StoneSequence::Impl {
  /// A stone as it was last seen.
  struct Known {
    JudgedStone seen;
    Stamp stamp{};
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    bool in_sight = true;  ///< in the last picture
  };
  /// Where a known stone should be now.
  struct Foretold {
    std::size_t known = 0;
    Eigen::Vector2d place;
    double reach_m = 0.0;  ///< how far from there it may be after all
    bool sure = true;
  };
  /// This picture's stones as far as they are known.
  struct Scene {
    std::vector<JudgedStone> stones;
    std::vector<std::optional<std::size_t>> known;  ///< of each: which one of the last picture's it is
    void add(const JudgedStone& stone, std::optional<std::size_t> which) {
      stones.push_back(stone);
      known.push_back(which);
    }
    bool taken(const Eigen::Vector2d& place) const {
      return std::any_of(stones.begin(), stones.end(), [&](const JudgedStone& s) {
        return s.doubt.empty() && (s.fit.place - place).norm() < taken_m;
      });
    }
    std::vector<NearerStone> believed() const {
      std::vector<NearerStone> all;
      for (const JudgedStone& s : stones) {
        if (s.doubt.empty()) all.push_back({s.fit.place, s.fit.handle});
      }
      return all;
    }
  };

  explicit Impl(const StonesSetup& given)
      : setup(given), lens(given.camera.intrinsics), response(given.camera.gamma), screening(given.teams) {}

  StoneFinder& finder(const Pose& eMc);
  StonesPercept look(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m,
                     const std::vector<StoneExpectation>& expected);
  StonesPercept look_at_all(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m);

  std::vector<Foretold> foretell(Stamp stamp, const std::vector<StoneExpectation>& expected, const SheetCamera& camera,
                                 std::vector<StoneExpectation>& unknown) const;
  void follow(const StonePicture& picture, const std::vector<Foretold>& foretold, bool in_sight, Scene& scene);
  void search(const StonePicture& picture, StoneGroups& places, const std::vector<Foretold>& missing,
              const std::vector<StoneExpectation>& unknown, const StoneArea& area, Scene& scene);
  void settle(const StonePicture& picture, const std::vector<Foretold>& missing, std::size_t first_new, Scene& scene);
  void follow_closer(const StonePicture& picture, std::vector<JudgedStone>& stones);
  void fit_together(const StonePicture& picture, const StoneFitOptions& options, std::vector<JudgedStone*>& stones);
  const WhiteLight& light(const cv::Mat& image, const Pose& eMc, int top, Stamp stamp);
  StoneGroups unexplained(const StonePicture& picture, StoneGroupFinder& groups, int count, const Scene& scene);
  void leave_out_asked(cv::Mat rows, int first_row, bool all);
  void forget_refused(Stamp stamp);
  StonesPercept report(const StonePicture& picture, const StoneArea& area, Stamp stamp, const Scene& scene) const;
  std::optional<std::size_t> formerly(const JudgedStone& stone, Stamp stamp, const std::vector<bool>& again) const;
  Eigen::Vector2d velocity_of(const Known& before, const Known& now) const;
  void remember(Stamp stamp, const Scene& scene);

  StonesSetup setup;
  Lens lens;
  ResponseCurve response;
  std::map<int, StoneFinder> finders;  ///< by the camera's pitch, in steps
  StoneVoter voter;
  CrowdScreening screening;
  StoneFitter fitter;
  std::optional<SharedLook> shared;  ///< as the last picture showed it
  std::vector<Known> known;
  std::optional<Stamp> last;
  int part = 0;   ///< whose turn it is
  int round = 0;  ///< how often all had it
  cv::Mat asked;  ///< of half the picture's size: where unexplained granite was asked about
  struct Refused {
    Eigen::Vector2d place;
    Stamp stamp{};
  };
  std::vector<Refused> refused;
  struct Lit {
    WhiteLight light;
    Pose eMc;
    Stamp stamp{};
    int top;
  };
  std::optional<Lit> lit;
  StoneSequenceDiagnosis diagnosis;
};

namespace {

double pitch_of(const Pose& eMc) { return std::asin(std::clamp(-eMc.linear()(2, 2), -1.0, 1.0)); }

/// The circle about a place, at a height, as it is seen; empty where not all of it is.
std::vector<cv::Point> seen_circle(const SheetCamera& camera, const Eigen::Vector2d& place, double radius_m,
                                   double height_m) {
  constexpr int points = 16;
  std::vector<cv::Point> outline;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    const auto pixel =
        camera.project({place.x() + radius_m * std::cos(angle), place.y() + radius_m * std::sin(angle), height_m});
    if (!pixel) return {};
    outline.emplace_back(static_cast<int>(std::lround(pixel->x())), static_cast<int>(std::lround(pixel->y())));
  }
  return outline;
}

/// The body's outline, a little larger.
std::vector<cv::Point> silhouette_of(const StonePicture& picture, const Eigen::Vector2d& place) {
  constexpr int points = 16;
  const auto centre = picture.camera.project({place.x(), place.y(), picture.shape.body_half_height_m});
  std::vector<cv::Point> outline;
  for (int i = 0; centre && i < points; ++i) {
    const auto pixel = picture.camera.project(
        body_outline_point(place, picture.shape, picture.eye(), 2.0 * std::numbers::pi * i / points));
    if (!pixel) return {};
    const Eigen::Vector2d p = *centre + silhouette * (*pixel - *centre);
    outline.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  }
  return outline;
}

/// Into a mask of half the picture's size from row `top` down.
void fill(cv::Mat& centres, int top, std::vector<cv::Point> outline, int value) {
  if (outline.empty()) return;
  for (cv::Point& p : outline) p = {p.x / 2, (p.y - top) / 2};
  cv::fillConvexPoly(centres, outline, cv::Scalar::all(value));
}

double apart_px(const StonePicture& picture, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double z_m = picture.shape.handle_height_m;
  const auto first = picture.camera.project({a.x(), a.y(), z_m}), second = picture.camera.project({b.x(), b.y(), z_m});
  return first && second ? (*first - *second).norm() : 1e3;
}

bool is_sure(const StoneExpectation& e, const SheetCamera& camera) {
  const Eigen::Vector3d eye = camera.eMc().translation();
  const Intrinsics& k = camera.lens().intrinsics();
  const double range_m = std::hypot(e.x_m - eye.x(), e.y_m - eye.y(), eye.z());
  return std::sqrt(e.covariance.yy_m2) * k.fy_px * eye.z() / (range_m * range_m) < sure_px &&
         std::sqrt(e.covariance.xx_m2) * k.fx_px / range_m < sure_px;
}

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
  const StoneArea area = stone_area(sheet_width_m);

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
    if (c.doubt.empty()) known.push_back({{c.votes, c.fit, {}, c.glimpsed}, stamp});
  }
  last = stamp;
  return seen;
}

// By its own motion; a tracker knows better. What only the tracker knows of is looked for by votes.
std::vector<StoneSequence::Impl::Foretold> StoneSequence::Impl::foretell(Stamp stamp,
                                                                         const std::vector<StoneExpectation>& expected,
                                                                         const SheetCamera& camera,
                                                                         std::vector<StoneExpectation>& unknown) const {
  std::vector<Foretold> all;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double dt_s = seconds(stamp - known[i].stamp);
    const double reach_m = std::clamp(struck_mps * dt_s, least_reach_m, most_reach_m);
    all.push_back({i, known[i].seen.fit.place + dt_s * known[i].velocity, reach_m, true});
  }
  for (const StoneExpectation& e : expected) {
    const Eigen::Vector2d place(e.x_m, e.y_m);
    const auto nearest = std::min_element(all.begin(), all.end(), [&](const Foretold& a, const Foretold& b) {
      return (a.place - place).norm() < (b.place - place).norm();
    });
    if (nearest == all.end() || (nearest->place - place).norm() > same_stone_m) {
      unknown.push_back(e);
    } else if (is_sure(e, camera)) {
      nearest->place = place;
    }
  }
  return all;
}

// All of them together, for they hide each other; those that were out of sight must not hide those that were in it.
void StoneSequence::Impl::follow(const StonePicture& picture, const std::vector<Foretold>& foretold, bool in_sight,
                                 Scene& scene) {
  std::vector<JudgedStone> stones;
  std::vector<std::size_t> which;
  for (const Foretold& f : foretold) {
    if (known[f.known].in_sight != in_sight || scene.taken(f.place)) continue;
    stones.push_back(known[f.known].seen);
    stones.back().candidate.place = stones.back().fit.place = f.place;
    which.push_back(f.known);
  }
  if (stones.empty()) return;
  StoneFitOptions options = follow_fit(shared);
  options.nearer = scene.believed();
  std::vector<JudgedStone*> all;
  for (JudgedStone& s : stones) all.push_back(&s);
  fit_together(picture, options, all);
  follow_closer(picture, stones);
  for (std::size_t i = 0; i < stones.size(); ++i) {
    const FittedStone &now = stones[i].fit, &before = known[which[i]].seen.fit;
    const bool worse = now.told < before.told - told_less || now.explained < before.explained - explained_less;
    if (stones[i].doubt.empty() && !worse) scene.add(stones[i], which[i]);
  }
}

// Those that are not where they were foretold, as a stone that was just struck.
void StoneSequence::Impl::follow_closer(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  StoneFitOptions options = found_fit(shared);
  std::vector<JudgedStone*> off;
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    const double px = apart_px(picture, s.candidate.place, s.fit.place);
    if (px > astray_px) s.doubt = "far from where it was foretold";
    if (px < close_px) options.nearer.push_back({s.fit.place, s.fit.handle});
    if (px >= close_px && px <= astray_px) off.push_back(&s);
  }
  if (off.empty()) return;
  std::vector<Eigen::Vector2d> before;
  for (const JudgedStone* s : off) before.push_back(s->fit.place);
  fit_together(picture, options, off);
  for (std::size_t i = 0; i < off.size(); ++i) {
    const bool settled = apart_px(picture, before[i], off[i]->fit.place) < close_px;
    if (off[i]->doubt.empty() && !settled) off[i]->doubt = "the fit does not come to an end";
  }
}

// Fits and judges; the handles that hide a stone are those of all others.
void StoneSequence::Impl::fit_together(const StonePicture& picture, const StoneFitOptions& options,
                                       std::vector<JudgedStone*>& stones) {
  std::vector<JudgedStone> before;
  for (const JudgedStone* s : stones) before.push_back(*s);
  const auto granite = clubs_granite(before);
  std::vector<StoneStart> starts;
  for (const JudgedStone* s : stones) starts.push_back({s->fit.place, s->glimpsed ? granite : std::nullopt});
  fitter.begin(picture, starts, options);
  const StoneFitResult& result = fitter.run();
  std::vector<NearerStone> others = options.nearer;
  for (const FittedStone& f : result.stones) others.push_back({f.place, f.handle});
  const Eigen::Vector2d eye = picture.eye().head<2>();
  for (std::size_t i = 0; i < stones.size(); ++i) {
    JudgedStone& s = *stones[i];
    s.fit = result.stones[i];
    s.doubt = s.glimpsed && granite ? doubt_of_glimpse(s.candidate, s.fit, *granite)
                                    : doubt_of(s.candidate, s.fit, may_be_hidden(s.fit.place, others, eye));
  }
  // What is no stone, or somebody's legs before one, would tell something else of it.
  const bool all_well =
      std::all_of(stones.begin(), stones.end(), [](const JudgedStone* s) { return s->doubt.empty(); });
  if (all_well && !stones.empty()) shared = result.look;
}

// Lamps stay: what white ice looks like is asked anew now and then.
const WhiteLight& StoneSequence::Impl::light(const cv::Mat& image, const Pose& eMc, int top, Stamp stamp) {
  const bool holds = lit && lit->top == top && seconds(stamp - lit->stamp) < light_s &&
                     Eigen::AngleAxisd(lit->eMc.linear().transpose() * eMc.linear()).angle() < light_turn_rad;
  if (!holds) lit.emplace(Lit{WhiteLight(image, response, top), eMc, stamp, top});
  return lit->light;
}

// Marks where there is granite that no known stone explains, in the parts of the picture whose turn it is.
StoneGroups StoneSequence::Impl::unexplained(const StonePicture& picture, StoneGroupFinder& groups, int count,
                                             const Scene& scene) {
  GroupSearch where;
  for (const JudgedStone& s : scene.stones) where.explained.push_back(silhouette_of(picture, s.fit.place));
  where.first_row = groups.part_begins(part, parts);
  const int end = std::min(part + count, parts);
  where.last_row = groups.part_begins(end, parts);
  StoneGroups places = groups.find_unexplained(picture.bgr, picture.ice, response, where);

  const double height_m = setup.shape.handle_height_m;
  for (const JudgedStone& s : scene.stones) {
    fill(places.centres, places.top, seen_circle(picture.camera, s.fit.place, taken_m, height_m), 0);
  }
  for (const Refused& r : refused) {
    fill(places.centres, places.top, seen_circle(picture.camera, r.place, refused_m, height_m), 0);
  }
  if (asked.size() != places.centres.size()) asked = cv::Mat::zeros(places.centres.size(), CV_8UC1);
  for (int p = part; p < end; ++p) {
    const int first = std::max(0, (groups.part_begins(p, parts) - places.top) / 2);
    const int last_row = std::min(places.centres.rows, (groups.part_begins(p + 1, parts) - places.top) / 2);
    if (first < last_row)
      leave_out_asked(places.centres.rowRange(first, last_row), first, (p + round) % asked_again == 0);
  }
  round += end == parts ? 1 : 0;
  part = end % parts;
  return places;
}

// What is no stone (trousers, a shadow) stays where it is: only now and then it is asked again.
void StoneSequence::Impl::leave_out_asked(cv::Mat rows, int first_row, bool all) {
  cv::Mat before = asked.rowRange(first_row, first_row + rows.rows);
  cv::Mat grown;
  cv::dilate(rows, grown, cv::Mat::ones(2 * same_mark_px + 1, 2 * same_mark_px + 1, CV_8UC1));
  if (!all) cv::subtract(rows, before, rows);
  grown.copyTo(before);
}

void StoneSequence::Impl::forget_refused(Stamp stamp) {
  std::erase_if(refused, [&](const Refused& r) { return seconds(stamp - r.stamp) > refused_s; });
}

// There, where a stone was lost and where a tracker expects one, by votes.
void StoneSequence::Impl::search(const StonePicture& picture, StoneGroups& places, const std::vector<Foretold>& missing,
                                 const std::vector<StoneExpectation>& unknown, const StoneArea& area, Scene& scene) {
  const double height_m = setup.shape.handle_height_m;
  const auto mark = [&](const Eigen::Vector2d& place, double radius_m, int value) {
    fill(places.centres, places.top, seen_circle(picture.camera, place, radius_m, height_m), value);
  };
  for (const Foretold& f : missing) mark(f.place, f.reach_m, 255);
  for (const StoneExpectation& e : unknown) {
    const double sigma_m = std::sqrt(e.covariance.xx_m2 + e.covariance.yy_m2);
    mark({e.x_m, e.y_m}, std::clamp(0.05 + 3.0 * sigma_m, 0.05, most_reach_m), 255);
  }
  if (!missing.empty() || !unknown.empty()) {
    for (const JudgedStone& s : scene.stones) mark(s.fit.place, taken_m, 0);
  }
  if (cv::countNonZero(places.centres) == 0) return;

  const auto& candidates = voter.find(picture, places, {.area = area.wider(look_around_m)});
  for (const JudgedStone& s : screening.look(picture, candidates)) {
    ++diagnosis.asked;
    if (!scene.taken(s.fit.place)) scene.add(s, std::nullopt);
  }
}

// What is new is fitted with what is known, and what was lost behind it once more.
void StoneSequence::Impl::settle(const StonePicture& picture, const std::vector<Foretold>& missing,
                                 std::size_t first_new, Scene& scene) {
  compare_granite(scene.stones);
  screening.tell_apart(picture, scene.stones);
  part_overlapping(picture, scene.stones);
  const bool doubted = std::any_of(scene.stones.begin() + static_cast<std::ptrdiff_t>(first_new), scene.stones.end(),
                                   [](const JudgedStone& s) { return !s.doubt.empty(); });
  if (doubted) screening.look_again(picture, scene.stones);
  part_overlapping(picture, scene.stones);
  scene.known.resize(scene.stones.size());
  for (const Foretold& f : missing) {
    if (scene.taken(f.place)) continue;
    scene.add(known[f.known].seen, f.known);
    scene.stones.back().candidate.place = scene.stones.back().fit.place = f.place;
  }
  StoneFitOptions options = found_fit(shared);
  std::vector<JudgedStone*> fresh;
  for (std::size_t i = 0; i < scene.stones.size(); ++i) {
    JudgedStone& s = scene.stones[i];
    if (!s.doubt.empty()) continue;
    if (i < first_new) {
      options.nearer.push_back({s.fit.place, s.fit.handle});
    } else {
      fresh.push_back(&s);
    }
  }
  if (!fresh.empty()) fit_together(picture, options, fresh);
  std::vector<Eigen::Vector2d> places;
  for (const NearerStone& s : scene.believed()) places.push_back(s.place);
  for (std::size_t i = first_new; i < scene.stones.size(); ++i) {
    JudgedStone& s = scene.stones[i];
    StoneSighting sighting = sighting_of(s, setup.teams);
    if (s.doubt.empty() && !scene.known[i]) s.doubt = last_doubt(picture, s, places, sighting);
  }
}

// After remember(). A handle's direction is asked of stones that run: it tells how they turn.
StonesPercept StoneSequence::Impl::report(const StonePicture& picture, const StoneArea& area, Stamp stamp,
                                          const Scene& scene) const {
  StonesPercept seen;
  seen.ok = true;
  seen.stamp = stamp;
  std::vector<Eigen::Vector2d> places;
  for (const NearerStone& s : scene.believed()) places.push_back(s.place);
  for (const Known& k : known) {
    if (!k.in_sight || !area.contains(k.seen.fit.place)) continue;
    seen.stones.push_back(sighting_of(k.seen, setup.teams));
    if (!k.velocity.isZero()) measure_turning_handle(picture, places, seen.stones.back());
  }
  seen.candidates = static_cast<int>(scene.stones.size());
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
  return seen;
}

// Which one of the last picture's a stone is that was found by votes: one that was lost and not yet found again.
std::optional<std::size_t> StoneSequence::Impl::formerly(const JudgedStone& stone, Stamp stamp,
                                                         const std::vector<bool>& again) const {
  std::optional<std::size_t> nearest;
  double least_m = most_reach_m;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (again[i] || !known[i].in_sight) continue;
    const double apart_m = (known[i].seen.fit.place - stone.fit.place).norm();
    if (apart_m < std::min(least_m, most_speed_mps * seconds(stamp - known[i].stamp))) least_m = apart_m, nearest = i;
  }
  return nearest;
}

// A place's own noise is no motion.
Eigen::Vector2d StoneSequence::Impl::velocity_of(const Known& before, const Known& now) const {
  const double dt_s = seconds(now.stamp - before.stamp);
  const Eigen::Vector2d moved = now.seen.fit.place - before.seen.fit.place;
  const double noise_m2 = (now.seen.fit.covariance + before.seen.fit.covariance).trace();
  const bool stood = before.velocity.isZero();
  if (stood && moved.norm() < std::max(least_moved_m, moved_sigmas * std::sqrt(0.5 * noise_m2))) return {0.0, 0.0};
  const Eigen::Vector2d velocity = moved / dt_s;
  if (velocity.norm() > most_speed_mps) return {0.0, 0.0};
  const Eigen::Vector2d smooth = stood ? velocity : before.velocity + velocity_share * (velocity - before.velocity);
  return smooth.norm() * dt_s < 0.25 * least_moved_m ? Eigen::Vector2d(0.0, 0.0) : smooth;
}

void StoneSequence::Impl::remember(Stamp stamp, const Scene& scene) {
  std::vector<Known> next;
  std::vector<bool> again(known.size(), false);
  for (const auto& which : scene.known) {
    if (which) again[*which] = true;
  }
  for (std::size_t i = 0; i < scene.stones.size(); ++i) {
    const JudgedStone& s = scene.stones[i];
    if (!s.doubt.empty() && !scene.known[i]) refused.push_back({s.candidate.place, stamp});
    if (!s.doubt.empty()) {
      if (scene.known[i]) again[*scene.known[i]] = false;
      continue;
    }
    Known now{s, stamp};
    const auto which = scene.known[i] ? scene.known[i] : formerly(s, stamp, again);
    if (which) now.velocity = velocity_of(known[*which], now);
    if (which) again[*which] = true;
    next.push_back(now);
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    Known& k = known[i];
    const double limit_s = k.velocity.isZero() ? remembered_standing_s : remembered_s;
    if (again[i] || seconds(stamp - k.stamp) > limit_s || scene.taken(k.seen.fit.place)) continue;
    k.in_sight = false;
    next.push_back(k);
  }
  known = std::move(next);
  last = stamp;
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
