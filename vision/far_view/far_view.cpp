#include "vision/far_view/far_view.hpp"

#include <algorithm>
#include <cmath>

#include "vision/far_view/far_view_impl.hpp"

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

ScreeningOptions far_screening() {
  ScreeningOptions options;
  options.hiding_m = far_hiding_m;
  return options;
}

}  // namespace

std::string unusable(const cv::Mat& image, const Intrinsics& intrinsics) {
  if (image.empty()) return "the picture is empty";
  if (image.type() != CV_8UC3) return "the picture is not 8 bits a channel in three colours";
  if (image.cols != intrinsics.width_px || image.rows != intrinsics.height_px) {
    return "the picture is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", the rig's camera " +
           std::to_string(intrinsics.width_px) + "x" + std::to_string(intrinsics.height_px);
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

FarView::Impl::Impl(const FarSetup& given)
    : setup(given),
      response(given.camera.gamma),
      sheet(given.camera),
      levels(given.camera.intrinsics),
      screening(far_screening()) {}

FarPercept FarView::Impl::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch) {
  FarPercept seen;
  seen.stamp = stamp;
  seen.reason = unusable(image, setup.camera.intrinsics);
  if (!seen.reason.empty()) return seen;

  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, response};
  const FarAim& aim = sheet.find(light, plan);
  if (!aim.ok) {
    seen.reason = "how the camera looks: " + aim.reason;
    return seen;
  }
  report_aim(aim, seen);

  levels.begin(image, response);
  levels.look_from(aim.eMc, setup.camera.ice);
  const FarArea area(aim, plan.sheet_width_m, setup.camera.sheet.width_m);
  const auto& places = scan.find(levels.middle().picture(response, setup.shape), area.whole().wider(look_around_m));

  find_stones(places, area, seen, sketch);
  seen.ok = true;
  return seen;
}

// Candidates of the places that are to be looked at on this level.
const std::vector<StoneCandidate>& FarView::Impl::vote(int level, const std::vector<FarPlace>& places,
                                                       const StoneArea& area) {
  candidates.clear();
  const StonePicture picture = levels[level].picture(response, setup.shape);
  groups.centres.create(picture.bgr.rows / 2, picture.bgr.cols / 2, CV_8UC1);
  groups.centres.setTo(0);
  const double scale = static_cast<double>(levels.middle().scale) / levels[level].scale;
  bool any = false;
  for (const FarPlace& place : places) {
    if (FarLevels::level_at(place.range_m, setup.camera.intrinsics) != level) continue;
    mark_for_votes(scale * place.pixel, scale * place.half_width_px, groups);
    any = true;
  }
  if (!any) return candidates;
  candidates = voter.find(picture, groups, {.area = area});
  for (StoneCandidate& c : candidates) c.drift_m = drift_m(c.place, picture.camera);
  return candidates;
}

// Level by level, near stones first: they may hide those behind.
void FarView::Impl::find_stones(const std::vector<FarPlace>& places, const FarArea& area, FarPercept& seen,
                                FarSketch* sketch) {
  std::vector<NearerStone> nearer;
  for (int level = FarLevels::count - 1; level >= 0; --level) {
    const StonePicture picture = levels[level].picture(response, setup.shape);
    std::vector<JudgedStone> stones =
        screening.judge(picture, vote(level, places, area.whole().wider(look_around_m)), nearer);
    screening.refine(picture, stones, nearer);

    for (JudgedStone& s : stones) {
      if (s.doubt.empty()) nearer.push_back({s.fit.place, s.fit.handle});
      if (s.doubt.empty() && !area.contains(s.fit.place)) s.doubt = "not on this sheet";
      if (s.doubt.empty()) seen.stones.push_back(sighting_of(s, setup.teams));
      if (sketch != nullptr) {
        const Eigen::Vector2d pixel = levels[level].scale * s.candidate.pixel;
        sketch->candidates.push_back({{pixel.x(), pixel.y()}, s.fit.place.x(), s.fit.place.y(), s.doubt});
      }
    }
    seen.candidates += static_cast<int>(stones.size());
  }
  seen.refused = seen.candidates - static_cast<int>(seen.stones.size());
}

FarView::FarView(const FarSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
FarView::~FarView() = default;
FarView::FarView(FarView&&) noexcept = default;
FarView& FarView::operator=(FarView&&) noexcept = default;

FarPercept FarView::look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch) {
  return impl_->look(image, stamp, plan, sketch);
}

}  // namespace hogline::vision
