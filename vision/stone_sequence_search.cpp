// What no known stone explains, a part of the picture at a time.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "vision/stone_sequence_impl.hpp"

namespace hogline::vision {
namespace {

constexpr int asked_again = 4;     // rounds after which what was no stone is asked again
constexpr int same_mark_px = 6;    // of half the picture's size
constexpr double refused_s = 1.0;  // for so long a place that is none is not asked again
constexpr double refused_m = 0.12;
constexpr double light_s = 0.25;          // lamps do not change faster,
constexpr double light_turn_rad = 0.015;  // nor does what a block of the picture shows of the ice
constexpr double look_around_m = 0.15;
constexpr double silhouette = 1.25;  // with the shadow about the foot

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

}  // namespace

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

  const auto& candidates = voter.find(picture, places, {.area = area.wider(look_around_m), .also_faint = true});
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
  for (const KnownStone& s : scene.believed()) places.push_back(s.place);
  for (std::size_t i = first_new; i < scene.stones.size(); ++i) {
    JudgedStone& s = scene.stones[i];
    StoneSighting sighting = sighting_of(s, setup.teams);
    if (s.doubt.empty() && !scene.known[i]) s.doubt = last_doubt(picture, s, places, sighting);
  }
}

}  // namespace hogline::vision
