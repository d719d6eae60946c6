#include "vision/fit/sheet_track.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "vision/edges/moving_edges.hpp"
#include "vision/fit/place_choice.hpp"
#include "vision/fit/sheet_fit_impl.hpp"

namespace hogline::vision {
namespace {

constexpr int wanted_places = 180;
constexpr std::size_t most_places = 2000;

constexpr double moved_sigma_px = 0.6;  // of a moving edge, which answers by whole pixels
constexpr double search_sigmas = 3.0;
constexpr int least_range_px = 2;
constexpr double close_look_px = 1.5;
constexpr double most_correction_px = 0.75;
constexpr int half_breadth = 2;

constexpr double most_innovation = 6.0;  // of six numbers together: a chance of 3e-6
// Of the places in each group. Measured among people and stones: 0.61 of the rings', 0.75 of the lines' at least; a
// wrong pose that rings and hog line agree with had 0.37 of the lines'.
constexpr std::array<double, 2> least_share{0.4, 0.5};
constexpr int least_lines = 15;

constexpr double still_px = 0.05;          // noise moves the fit by as much
constexpr double pitch_by_movement = 2.0;  // a pitch moves lines across by its own angle, others by less

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

struct SheetTrack::Impl {
  Impl(const CameraSetup& setup, const ChoiceWishes& wishes)
      : fit(setup), choice(wanted_places, most_places, wishes), cameras(fit.lens, bMc(setup.mount), setup.ice) {
    moved.reserve(most_places);
  }

  const SheetFitResult& begin(const cv::Mat& image, const SheetFitStart& given);
  const SheetFitResult& take_over(const SheetFit::Impl& fitted, const SheetFitStart& given);
  const SheetFitResult& follow(const cv::Mat& image, const SheetPrediction& prediction);

  void begin_tracking();
  void expect_pitch(const PitchMemory& memory, double change_rad);
  bool recall_pitch(const PitchMemory& memory);
  void report_pitch();
  bool arrived() const;
  bool fit_frame(const PictureLight& light, const SheetPrediction& prediction);
  void plan();
  void see_from(const FitState& state, const Vector6& travel);
  bool come_closer(const Picture& picture, const SheetPrediction& prediction);
  void remember();
  std::string doubt(const SheetPrediction& prediction);

  SheetFit::Impl fit;  // its state and sites are the tracker's
  PlaceChoice choice;
  MovingEdges edges;
  SiteCameras cameras;
  SheetFitStart start;  // what holds from frame to frame
  double start_pitch_sigma_rad = 0.0;
  std::vector<SiteMeasurement> moved;
  std::array<std::array<float, 3>, paint_feature_count> colours{};
  FitState last;  // that was believed
  bool lost = true;
  TrackDiagnosis diagnosis;
};

const SheetFitResult& SheetTrack::Impl::begin(const cv::Mat& image, const SheetFitStart& given) {
  start = given;
  fit.fit(image, start);
  begin_tracking();
  return fit.result;
}

const SheetFitResult& SheetTrack::Impl::take_over(const SheetFit::Impl& fitted, const SheetFitStart& given) {
  start = given;
  fit.state = fitted.state;
  fit.covariance = fitted.covariance;
  fit.sites = fitted.sites;
  fit.found = fitted.found;
  fit.step = fitted.step;
  fit.result = fitted.result;
  begin_tracking();
  return fit.result;
}

void SheetTrack::Impl::begin_tracking() {
  diagnosis = {};
  lost = !fit.result.ok;
  if (lost) return;
  start_pitch_sigma_rad = start.pitch_sigma_rad;
  BodyByParameters body = BodyByParameters::Zero();
  body.leftCols<6>() = fit.body_by_twist();
  choice.judge_by(fit.covariance, body);
  for (auto& colour : colours) colour = {1.0F, 1.0F, 1.0F};
  remember();
  report_pitch();
  choice.choose_all(fit.camera(), fit.state, fit.sites);
}

const SheetFitResult& SheetTrack::Impl::follow(const cv::Mat& image, const SheetPrediction& prediction) {
  diagnosis = {};
  fit.clear_result();
  start.eMc = prediction.eMc;
  if (std::string why = fit.unusable(image, start); !why.empty()) return fit.refuse(std::move(why));
  if (!prediction.covariance.allFinite() || !prediction.travel.allFinite()) return fit.refuse("no usable prediction");
  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, fit.response};

  if (prediction.pitch) expect_pitch(*prediction.pitch, prediction.pitch->most_change_rad);
  fit.state = last;
  fit.state.eMc = prediction.eMc;
  plan();
  lost = true;
  if (!fit_frame(light, prediction)) return fit.refuse("the fit ran away");
  fit.judge(start);
  report_pitch();
  if (!fit.result.ok) return fit.result;
  if (std::string why = doubt(prediction); !why.empty()) return fit.refuse(std::move(why));
  remember();
  return fit.result;
}

// To a pixel by the moving edges, then to a fraction of one.
bool SheetTrack::Impl::fit_frame(const PictureLight& light, const SheetPrediction& prediction) {
  see_from(fit.state, prediction.travel);
  if (!come_closer(light.picture, prediction)) return false;
  for (int round = 0; round < 2; ++round) {
    see_from(fit.state, prediction.travel);
    fit.look(light, close_look_px, half_breadth);
    fit.drop_odd_colours();
    step_closely(fit.sites, fit.found, fit.prior(start), fit.step, fit.scratch);
    if (prediction.pitch && recall_pitch(*prediction.pitch)) {
      step_closely(fit.sites, fit.found, fit.prior(start), fit.step, fit.scratch);
    }
    if (!fit.move_by(fit.step.change)) return false;
    if (arrived()) break;
  }
  return true;
}

// What is left of the memory after a change of pitch (one standard deviation) since: its own error and the change's,
// and in the long run no more than the mount tells.
void SheetTrack::Impl::expect_pitch(const PitchMemory& memory, double change_rad) {
  const double at_rest = start_pitch_sigma_rad * start_pitch_sigma_rad;
  const double change = std::min(change_rad * change_rad, at_rest);
  const double kept = at_rest > 0.0 ? 1.0 - change / at_rest : 1.0;
  start.pitch_offset_rad = std::sqrt(kept) * memory.offset_rad;
  start.pitch_sigma_rad = std::sqrt(kept * memory.sigma_rad * memory.sigma_rad + change);
}

// How far the picture has moved since says how much the pitch can have changed. True: the prior is the tighter for it.
bool SheetTrack::Impl::recall_pitch(const PitchMemory& memory) {
  const Twist off = log(memory.eMc.inverse() * fit.state.eMc);
  ParameterVector moved_since = ParameterVector::Zero();
  moved_since << off.linear, off.angular, Eigen::Matrix<double, parameter::count - 6, 1>::Zero();
  moved_since.head<6>() += fit.step.change.head<6>();
  double square = 0.0;
  for (const PlannedSite& site : fit.sites) {
    const double moved_px = site.along.head<6>().dot(moved_since.head<6>());
    square += moved_px * moved_px;
  }
  diagnosis.moved_px = std::sqrt(square / std::max<double>(1.0, static_cast<double>(fit.sites.size())));
  const double before = start.pitch_sigma_rad;
  const double change_rad =
      pitch_by_movement * std::max(0.0, diagnosis.moved_px - still_px) / fit.setup.intrinsics.fy_px;
  expect_pitch(memory, std::min(change_rad, memory.most_change_rad));
  return start.pitch_sigma_rad < 0.8 * before;
}

void SheetTrack::Impl::report_pitch() {
  diagnosis.pitch_offset_rad = fit.pitch();
  diagnosis.pitch_sigma_rad = fit.pitch_sigma();
}

// No place moved so far that others may have been beyond the close look's end, or the view bent.
bool SheetTrack::Impl::arrived() const {
  return std::none_of(fit.sites.begin(), fit.sites.end(), [this](const PlannedSite& site) {
    return std::abs(site.along.dot(fit.step.change)) > most_correction_px;
  });
}

// A frame that was not believed may have let go of places that are in view again.
void SheetTrack::Impl::plan() {
  if (lost) {
    choice.choose_all(fit.camera(), fit.state, fit.sites);
  } else {
    choice.renew_one_feature(fit.camera(), fit.state, fit.sites);
  }
}

// Every place as this state sees it; those no longer in view are let go.
void SheetTrack::Impl::see_from(const FitState& state, const Vector6& travel) {
  cameras.paint = fit.camera();
  cameras.surface.move_to(state.eMc);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fit.sites.size(); ++i) {
    PlannedSite& site = fit.sites[i];
    if (!reproject(cameras, state, site)) continue;
    const double travelled_px = std::abs(site.along.head<6>().dot(travel));
    site.blur_px = std::hypot(SitePlan{}.optical_blur_px, travelled_px / std::sqrt(12.0));
    if (kept != i) fit.sites[kept] = site;
    ++kept;
  }
  fit.sites.resize(kept);
}

// By the moving edges to within a pixel.
bool SheetTrack::Impl::come_closer(const Picture& picture, const SheetPrediction& prediction) {
  moved.clear();
  diagnosis.places = static_cast<int>(fit.sites.size());
  for (PlannedSite& site : fit.sites) {
    const Vector6 along = site.along.head<6>().transpose();
    const double sigma_px = std::sqrt(along.dot(prediction.covariance * along));
    const double range_px = std::ceil(search_sigmas * sigma_px);
    MovingEdge edge;
    edge.pixel = site.pixel;
    edge.normal = site.normal;
    edge.width_px = site.step ? -1.0 : site.width_px;
    edge.range_px = static_cast<int>(std::clamp<double>(range_px, least_range_px, MovingEdges::max_range_px));
    edge.contrast = site.seen_contrast;
    edge.colour = colours[static_cast<std::size_t>(site.feature)];
    const MovedEdge seen = edges.follow(picture, edge);
    SiteMeasurement m;
    m.found = seen.found;
    m.offset_px = seen.offset_px;
    m.sigma_px = moved_sigma_px;
    moved.push_back(m);
    if (seen.found) site.seen_contrast = seen.contrast;
    diagnosis.moved += seen.found ? 1 : 0;
    diagnosis.search_px = std::max(diagnosis.search_px, static_cast<double>(edge.range_px));
  }
  Prior prior = fit.prior(start);
  prior.information.topLeftCorner<6, 6>() += prediction.covariance.ldlt().solve(Matrix6::Identity());
  step_closely(fit.sites, moved, prior, fit.step, fit.scratch);
  return fit.move_by(fit.step.change);
}

// What the next frame goes by: each place's contrast and blur, each feature's colour.
void SheetTrack::Impl::remember() {
  std::array<Eigen::Vector3f, paint_feature_count> sum;
  sum.fill(Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < fit.sites.size(); ++i) {
    PlannedSite& site = fit.sites[i];
    site.borne_out = fit.step.weight[i] > 0.0 ? 1 : -1;
    if (fit.step.weight[i] <= 0.0) {
      site.seen_contrast = 0.0;  // of something else
      continue;
    }
    site.seen_blur_px = fit.found[i].blur_px;
    const Eigen::Vector3f colour = Eigen::Map<const Eigen::Vector3f>(fit.found[i].colour.data());
    sum[static_cast<std::size_t>(site.feature)] += site.sense < 0 ? Eigen::Vector3f(-colour) : colour;
  }
  for (std::size_t f = 0; f < paint_feature_count; ++f) {
    if (sum[f].norm() > 1e-3F) Eigen::Map<Eigen::Vector3f>(colours[f].data()) = sum[f].normalized();
  }
  last = fit.state;
  lost = false;
}

// Why a fit that is determined is not believed.
std::string SheetTrack::Impl::doubt(const SheetPrediction& prediction) {
  const Twist off = log(prediction.eMc.inverse() * fit.state.eMc);
  Vector6 change;
  change << off.linear, off.angular;
  const Matrix6 expected = prediction.covariance + fit.result.covariance;
  diagnosis.innovation = std::sqrt(change.dot(expected.ldlt().solve(change)));
  if (!(diagnosis.innovation < most_innovation)) return "the fit is far from where the frames before put it";

  std::array<int, 2> tried{};
  std::array<int, 2> used{};
  for (const FittedFeature& f : fit.result.features) {
    const std::size_t group = f.name.ends_with("_ring") || f.name == "button" ? 0 : 1;
    tried[group] += f.sites_tried;
    used[group] += f.sites_used;
  }
  if (used[0] < least_share[0] * tried[0]) return "the rings are not where the frame before puts them";
  if (used[1] < std::max<double>(least_lines, least_share[1] * tried[1])) {
    return "the lines are not where the frame before puts them";
  }
  return {};
}

SheetTrack::SheetTrack(const CameraSetup& setup, const ChoiceWishes& wishes)
    : impl_(std::make_unique<Impl>(setup, wishes)) {}
SheetTrack::~SheetTrack() = default;
SheetTrack::SheetTrack(SheetTrack&&) noexcept = default;
SheetTrack& SheetTrack::operator=(SheetTrack&&) noexcept = default;

const SheetFitResult& SheetTrack::begin(const cv::Mat& image, const SheetFitStart& start) {
  return impl_->begin(image, start);
}

const SheetFitResult& SheetTrack::begin(const SheetFit& fitted, const SheetFitStart& start) {
  return impl_->take_over(*fitted.impl_, start);
}

const SheetFitResult& SheetTrack::follow(const cv::Mat& image, const SheetPrediction& prediction) {
  return impl_->follow(image, prediction);
}

const SheetFitResult& SheetTrack::result() const { return impl_->fit.result; }
const TrackDiagnosis& SheetTrack::diagnosis() const { return impl_->diagnosis; }

}  // namespace hogline::vision
