#include "vision/far_view/far_view.hpp"

#include <algorithm>
#include <cmath>

#include "vision/far_view/far_verdict.hpp"
#include "vision/far_view/far_view_impl.hpp"
#include "vision/handle_angle.hpp"
#include "vision/picture/picture_shape.hpp"

namespace hogline::vision {
namespace {

constexpr double first_y_m = -2.4;     // behind the back line
constexpr double beyond_hog_m = 2.5;   // beyond the far hog line: still in the thrower's hand
constexpr double beside_m = 0.05;      // its centre beyond the sideline by more: a neighbour's
constexpr double look_around_m = 0.3;  // places of votes are good to a pixel or two
constexpr double near_drift_m = 0.16;
constexpr double drift_px = 2.5;
constexpr double far_hiding_m =
    3.0;  // a stone hides what stands behind it for so far: 0.2 m of it, seen from 2 m at 30 m

constexpr double least_height_m = 0.5;  // of the camera: a stone must be seen from above
constexpr double grip_top_m = 0.20;     // over the ice
constexpr double spare_px = 12.0;       // about what is looked at of a stone
constexpr int rows_above = 24;          // of the picture, for what is looked at about a stone

// What was found on the level before, near the border of the two, is not found again.
void make_room(const StonePicture& picture, const std::vector<KnownStone>& nearer, std::vector<JudgedStone>& stones) {
  for (JudgedStone& s : stones) {
    const bool taken = std::any_of(nearer.begin(), nearer.end(), [&](const KnownStone& n) {
      return stand_in_one_place(s.fit.place, n.place, picture);
    });
    if (s.doubt.empty() && taken) s.doubt = no_room;
  }
  part_overlapping(picture, stones);
}

}  // namespace

ScreeningOptions careful_screening() {
  ScreeningOptions options;
  options.hiding_m = far_hiding_m;
  return options;
}

ScreeningOptions quick_screening() {
  ScreeningOptions options = careful_screening();
  options.all = {.iterations = 2, .pixels = 130};
  return options;
}

std::string unusable(const cv::Mat& image, const Intrinsics& intrinsics, const FarPlan& plan) {
  if (std::string fault = shape_fault(image, intrinsics); !fault.empty()) return fault;
  if (!is_finite(plan.eMc) || !(plan.eMc.translation().z() > least_height_m)) {
    return "the plan puts the camera nowhere above the ice";
  }
  return {};
}

FarArea::FarArea(const FarAim& aim, std::optional<double> planned_width_m, double nominal_width_m) {
  const double half_m = 0.5 * planned_width_m.value_or(nominal_width_m);
  left_m_ = right_m_ = half_m;
  // One sideline tells of the other: the centre line runs in the middle.
  if (aim.sidelines[0].known) left_m_ = right_m_ = aim.sidelines[0].edge_m;
  if (aim.sidelines[1].known) right_m_ = aim.sidelines[1].edge_m;
  if (aim.sidelines[1].known && !aim.sidelines[0].known) left_m_ = right_m_;
  whole_.half_width_m = std::max(left_m_, right_m_) + beside_m;
  whole_.min_y_m = first_y_m;
  whole_.max_y_m = rules::tee_to_tee_m - rules::tee_to_hog_m + beyond_hog_m;
}

bool FarArea::contains(const Eigen::Vector2d& place) const {
  return whole_.contains(place) && place.x() > -left_m_ - beside_m && place.x() < right_m_ + beside_m;
}

double drift_m(const Eigen::Vector2d& place, const SheetCamera& camera) {
  const Eigen::Vector3d eye = camera.eMc().translation();
  const double range_m = (place - eye.head<2>()).norm();
  return std::max(near_drift_m, drift_px * range_m * range_m / (camera.lens().intrinsics().fy_px * eye.z()));
}

void report_aim(const FarAim& aim, FarPercept& seen) {
  seen.correction = aim.correction;
  seen.eMc = row_major(aim.eMc);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) seen.covariance[static_cast<std::size_t>(6 * i + j)] = aim.covariance(i, j);
  }
  for (int i = 0; i < 3; ++i) seen.camera_sigma_m[static_cast<std::size_t>(i)] = std::sqrt(aim.covariance(i, i));
  seen.residual_px = aim.residual_px;
  seen.sites_used = aim.sites_used;
  seen.sites_tried = aim.sites_tried;
  seen.features = aim.features;
}

int first_row(const FarArea& area, const SheetCamera& camera) {
  const auto farthest = camera.project({0.0, area.whole().max_y_m, grip_top_m});
  return farthest ? std::max(0, static_cast<int>(farthest->y()) - rows_above) : 0;
}

FarView::Impl::Impl(const FarSetup& given, const ScreeningOptions& options)
    : setup(given),
      response(given.camera.gamma),
      sheet(given.camera),
      levels(given.camera.intrinsics),
      screening(options),
      crowd(given.teams) {}

FarPercept FarView::Impl::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch) {
  FarPercept seen;
  seen.stamp = stamp;
  seen.reason = unusable(image, setup.camera.intrinsics, plan);
  if (!seen.reason.empty()) return seen;

  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, response};
  const FarAim& aim = sheet.find(light, plan);
  if (!aim.ok) {
    seen.reason = "how the camera looks: " + aim.reason;
    return seen;
  }
  report_aim(aim, seen);

  const FarArea area = area_of(aim, plan);
  begin(image, aim.eMc, area);
  const std::vector<JudgedStone> stones = find_stones({scan_part(area, {}), {}, true}, area);

  report(stones, seen);
  const StonePicture whole = levels[0].picture(response, setup.shape);
  std::vector<Eigen::Vector2d> places;
  for (const StoneSighting& s : seen.stones) places.emplace_back(s.x_m, s.y_m);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if ((places[i] - whole.eye().head<2>()).norm() < handle_range_m) measure_handle(whole, places, seen.stones[i]);
  }
  if (sketch == nullptr) return seen;
  for (const JudgedStone& s : stones) {
    const auto pixel = levels[0].camera->project({s.fit.place.x(), s.fit.place.y(), setup.shape.handle_height_m});
    if (pixel) sketch->candidates.push_back({{pixel->x(), pixel->y()}, s.fit.place.x(), s.fit.place.y(), s.doubt});
  }
  return seen;
}

FarArea FarView::Impl::area_of(const FarAim& aim, const FarPlan& plan) const {
  return {aim, plan.sheet_width_m, setup.camera.sheet.width_m};
}

void FarView::Impl::begin(const cv::Mat& image, const Pose& eMc, const FarArea& area) {
  const SheetCamera camera(*levels[0].lens, eMc, setup.camera.ice);
  levels.begin(image, first_row(area, camera), response, eMc, setup.camera.ice);
}

void FarView::Impl::go_on(const cv::Mat& image, const Pose& eMc) { levels.go_on(image, eMc, setup.camera.ice); }

const std::vector<FarPlace>& FarView::Impl::scan_part(const FarArea& area, const FarScan::Part& part) {
  return scan.find(levels.middle().picture(response, setup.shape), levels[0].bgr, area.whole().wider(look_around_m),
                   part);
}

FarPlace FarView::Impl::place_of(const Eigen::Vector2d& place) const {
  const SheetCamera& camera = *levels.middle().camera;
  const Eigen::Vector3d eye = camera.eMc().translation();
  FarPlace p;
  p.range_m = (place - eye.head<2>()).norm();
  const auto pixel = camera.project({place.x(), place.y(), setup.shape.handle_height_m});
  p.pixel = pixel ? cv::Point2d(pixel->x(), pixel->y()) : cv::Point2d(-1e3, -1e3);
  p.half_width_px = setup.shape.body_radius_m * camera.lens().intrinsics().fx_px / std::max(1.0, p.range_m);
  return p;
}

// From half a metre over the ice to half a metre before the foot: where verdicts look for somebody's legs.
void FarView::Impl::fill(int level, const FarPlace& place) {
  const double scale = static_cast<double>(levels.middle().scale) / levels[level].scale;
  const double half_px = scale * place.half_width_px;
  const double x = scale * place.pixel.x, y = scale * place.pixel.y;
  const cv::Point2d begin(x - 2.4 * half_px - spare_px, y - 4.2 * half_px - spare_px);
  const cv::Point2d end(x + 2.4 * half_px + spare_px, y + 3.0 * half_px + spare_px);
  levels.fill(level, cv::Rect(cv::Point(begin), cv::Point(end)));
}

// Candidates of the places that are to be looked at on this level.
const std::vector<StoneCandidate>& FarView::Impl::vote(int level, const std::vector<FarPlace>& places,
                                                       const FarArea& area) {
  candidates.clear();
  const StonePicture picture = levels[level].picture(response, setup.shape);
  const double scale = static_cast<double>(levels.middle().scale) / levels[level].scale;
  centres.create(picture.bgr.rows / 2, picture.bgr.cols / 2, CV_8UC1);
  centres.setTo(0);
  cv::Rect marked;
  for (const FarPlace& place : places) {
    if (FarLevels::level_at(place.range_m, setup.camera.intrinsics) != level) continue;
    marked |= mark_for_votes(scale * place.pixel, scale * place.half_width_px, centres);
    fill(level, place);
  }
  if (marked.empty()) return candidates;
  const StoneGroups rows{{}, centres.rowRange(marked.y, marked.br().y), 2 * marked.y};
  candidates = voter.find(picture, rows, {.area = area.whole().wider(look_around_m)});
  for (StoneCandidate& c : candidates) c.drift_m = drift_m(c.place, picture.camera);
  return candidates;
}

// Level by level, near stones first: they may hide those behind.
std::vector<JudgedStone> FarView::Impl::find_stones(const FarSearch& search, const FarArea& area) {
  std::vector<JudgedStone> all;
  std::vector<KnownStone> nearer;
  const Eigen::Vector2d eye = levels[0].camera->eMc().translation().head<2>();
  for (int level = FarLevels::count - 1; level >= 0; --level) {
    const StonePicture picture = levels[level].picture(response, setup.shape);
    std::vector<JudgedStone> stones = screening.judge(picture, vote(level, search.places, area), nearer);
    for (const JudgedStone& s : search.stones) {
      const double range_m = (s.fit.place - eye).norm();
      if (FarLevels::level_at(range_m, setup.camera.intrinsics) != level) continue;
      fill(level, place_of(s.fit.place));
      stones.push_back(s);
    }
    if (stones.empty()) continue;
    if (search.behind) crowd.look_behind(picture, stones);
    make_room(picture, nearer, stones);
    screening.refine(picture, stones, nearer);

    std::vector<KnownStone> standing = nearer;
    for (const JudgedStone& s : stones) {
      if (s.doubt.empty()) standing.push_back({s.fit.place, s.fit.handle});
    }
    for (JudgedStone& s : stones) {
      if (s.doubt.empty()) s.doubt = doubt_of_surroundings(picture, s, standing);
      if (s.doubt.empty()) nearer.push_back({s.fit.place, s.fit.handle});
      if (s.doubt.empty() && !area.contains(s.fit.place)) s.doubt = "not on this sheet";
    }
    all.insert(all.end(), stones.begin(), stones.end());
  }
  return all;
}

void FarView::Impl::report(const std::vector<JudgedStone>& stones, FarPercept& seen) const {
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) seen.stones.push_back(sighting_of(s, setup.teams));
  }
  seen.candidates = static_cast<int>(stones.size());
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
  seen.ok = true;
}

FarView::FarView(const FarSetup& setup) : impl_(std::make_unique<Impl>(setup, careful_screening())) {}
FarView::~FarView() = default;
FarView::FarView(FarView&&) noexcept = default;
FarView& FarView::operator=(FarView&&) noexcept = default;

FarPercept FarView::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch) {
  return impl_->look(image, stamp, plan, sketch);
}

}  // namespace hogline::vision
