#include "vision/fit/sheet_track.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "vision/edges/moving_edges.hpp"
#include "vision/fit/sheet_fit_impl.hpp"

namespace hogline::vision {
namespace {

constexpr double plan_spacing_px = 10.0;
constexpr double wanted_places = 180.0;
constexpr double even_share = 0.4;  // of the places are spread evenly, the others go where they tell most
constexpr double place_sigma_px = 0.1;

constexpr double moved_sigma_px = 0.6;  // of a moving edge, which answers by whole pixels
constexpr double search_sigmas = 3.0;
constexpr int least_range_px = 2;
constexpr double close_look_px = 1.5;
constexpr int half_breadth = 2;

constexpr double most_innovation = 6.0;  // sigmas
constexpr double least_group_share = 0.3;
constexpr int least_lines = 15;

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

struct SheetTrack::Impl {
  explicit Impl(const CameraSetup& setup) : fit(setup), cameras(fit.lens, bMc(setup.mount), setup.ice) {
    planned.reserve(1000);
    contrast.reserve(2000);
    moved.reserve(2000);
  }

  const SheetFitResult& begin(const cv::Mat& image, const SheetFitStart& given);
  const SheetFitResult& follow(const cv::Mat& image, const SheetPrediction& prediction);

  void plan_all();
  void renew_one_feature();
  void plan(int feature);
  template <typename Place>
  void choose(const Place& place);
  double tells(const PlannedSite& site) const;
  void see_from(const FitState& state, const Vector6& travel);
  bool come_closer(const Picture& picture, const SheetPrediction& prediction);
  void remember();
  std::string lost(const SheetPrediction& prediction);

  SheetFit::Impl fit;
  MovingEdges edges;
  SiteCameras cameras;
  SheetFitStart start;
  std::vector<PlannedSite> planned;
  std::vector<double> contrast;  // of each site, as the moving edges saw it last
  std::vector<MovedEdge> seen;
  std::vector<SiteMeasurement> moved;
  std::array<std::array<float, 3>, paint_feature_count> colours{};
  Eigen::Matrix<double, 3, parameter::count> worth;  // of the covariance, see tells()
  double even = 0.0;
  double quantum = 0.0;
  int next_feature = 0;
  TrackDiagnosis diagnosis;
};

const SheetFitResult& SheetTrack::Impl::begin(const cv::Mat& image, const SheetFitStart& given) {
  start = given;
  seen.clear();
  const SheetFitResult& result = fit.fit(image, start);
  if (!result.ok) return result;
  for (auto& colour : colours) colour = {1.0F, 1.0F, 1.0F};
  remember();
  plan_all();
  return result;
}

const SheetFitResult& SheetTrack::Impl::follow(const cv::Mat& image, const SheetPrediction& prediction) {
  assert(!fit.sites.empty());
  diagnosis = {};
  fit.clear_result();
  start.eMc = prediction.eMc;
  if (std::string why = fit.unusable(image, start); !why.empty()) return fit.refuse(std::move(why));
  const PictureLight light{{image.data, image.cols, image.rows, image.channels(), image.step[0]}, fit.response};

  fit.state.eMc = prediction.eMc;
  renew_one_feature();
  see_from(fit.state, prediction.travel);
  if (!come_closer(light.picture, prediction)) return fit.refuse("the moving edges lead nowhere");

  see_from(fit.state, prediction.travel);
  fit.look(light, close_look_px, half_breadth);
  fit.drop_odd_colours();
  step_closely(fit.sites, fit.found, fit.prior(start), fit.step, fit.scratch);
  if (!fit.move_by(fit.step.change)) return fit.refuse("the fit ran away");
  fit.judge(start);

  if (fit.result.ok) {
    if (std::string why = lost(prediction); !why.empty()) return fit.refuse(std::move(why));
    remember();
  }
  return fit.result;
}

// What a place tells of the body's x, y and yaw: the share of their variances that it took away.
double SheetTrack::Impl::tells(const PlannedSite& site) const {
  return (worth * site.along.transpose()).squaredNorm() /
         (place_sigma_px * place_sigma_px + site.floor_px * site.floor_px);
}

// Takes places in turn, as often as they are worth: everywhere a few, and most where they tell most.
template <typename Place>
void SheetTrack::Impl::choose(const Place& place) {
  double sum = 0.5 * quantum;
  for (const PlannedSite& site : planned) {
    sum += even + tells(site);
    if (sum < quantum) continue;
    sum = std::min(sum - quantum, quantum);
    place(site);
  }
}

void SheetTrack::Impl::plan(int feature) {
  SitePlan how;
  how.spacing_px = plan_spacing_px;
  how.only_feature = feature;
  planned.clear();
  plan_sites(fit.camera(), fit.state, how, planned);
}

void SheetTrack::Impl::plan_all() {
  Eigen::Matrix<double, 3, parameter::count> by_change = Eigen::Matrix<double, 3, parameter::count>::Zero();
  by_change.leftCols<6>() = fit.body_by_twist();
  worth.noalias() = by_change * fit.covariance;
  for (int k = 0; k < 3; ++k) worth.row(k) /= std::sqrt(std::max(worth.row(k).dot(by_change.row(k)), 1e-18));
  plan(-1);
  double sum = 0.0;
  for (const PlannedSite& site : planned) sum += tells(site);
  even = even_share / (1.0 - even_share) * sum / std::max(1.0, static_cast<double>(planned.size()));
  quantum = sum / (1.0 - even_share) / wanted_places;
  fit.sites.clear();
  contrast.clear();
  choose([this](const PlannedSite& site) {
    fit.sites.push_back(site);
    contrast.push_back(0.0);
  });
}

// The view changes as the robot moves: one feature after the other is planned anew, a frame each.
void SheetTrack::Impl::renew_one_feature() {
  const int feature = next_feature;
  next_feature = (next_feature + 1) % paint_feature_count;
  const auto in_feature = [&](const PlannedSite& site) { return site.feature < feature; };
  const auto first = std::partition_point(fit.sites.begin(), fit.sites.end(), in_feature);
  const auto last = std::find_if(first, fit.sites.end(), [&](const PlannedSite& s) { return s.feature != feature; });
  const auto at = first - fit.sites.begin();
  const auto many = last - first;
  fit.sites.erase(first, last);
  contrast.erase(contrast.begin() + at, contrast.begin() + at + many);

  plan(feature);
  auto place = at;
  choose([&](const PlannedSite& site) {
    fit.sites.insert(fit.sites.begin() + place, site);
    contrast.insert(contrast.begin() + place, 0.0);
    ++place;
  });
  const double too_many = static_cast<double>(fit.sites.size()) / wanted_places;
  quantum *= std::pow(std::clamp(too_many, 0.5, 2.0), 1.0 / paint_feature_count);
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
    if (kept != i) {
      fit.sites[kept] = site;
      contrast[kept] = contrast[i];
    }
    ++kept;
  }
  fit.sites.resize(kept);
  contrast.resize(kept);
}

// By the moving edges to within a pixel.
bool SheetTrack::Impl::come_closer(const Picture& picture, const SheetPrediction& prediction) {
  seen.clear();
  moved.clear();
  diagnosis.places = static_cast<int>(fit.sites.size());
  for (std::size_t i = 0; i < fit.sites.size(); ++i) {
    const PlannedSite& site = fit.sites[i];
    const Vector6 along = site.along.head<6>().transpose();
    const double sigma_px = std::sqrt(along.dot(prediction.covariance * along));
    MovingEdge edge;
    edge.pixel = site.pixel;
    edge.normal = site.normal;
    edge.width_px = site.step ? -1.0 : site.width_px;
    edge.range_px =
        std::clamp(static_cast<int>(std::ceil(search_sigmas * sigma_px)), least_range_px, MovingEdges::max_range_px);
    edge.contrast = contrast[i];
    edge.colour = colours[static_cast<std::size_t>(site.feature)];
    seen.push_back(edges.follow(picture, edge));
    SiteMeasurement m;
    m.found = seen.back().found;
    m.offset_px = seen.back().offset_px;
    m.sigma_px = moved_sigma_px;
    moved.push_back(m);
    diagnosis.moved += m.found ? 1 : 0;
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
    if (fit.step.weight[i] <= 0.0) continue;
    PlannedSite& site = fit.sites[i];
    site.seen_blur_px = fit.found[i].blur_px;
    const float sense = site.sense < 0 ? -1.0F : 1.0F;
    sum[static_cast<std::size_t>(site.feature)] +=
        sense * Eigen::Map<const Eigen::Vector3f>(fit.found[i].colour.data());
    if (i < seen.size() && seen[i].found) contrast[i] = seen[i].contrast;
  }
  for (std::size_t f = 0; f < paint_feature_count; ++f) {
    if (sum[f].norm() > 1e-3F) Eigen::Map<Eigen::Vector3f>(colours[f].data()) = sum[f].normalized();
  }
}

// Why a fit that is determined is not believed.
std::string SheetTrack::Impl::lost(const SheetPrediction& prediction) {
  const Twist off = log(prediction.eMc.inverse() * fit.state.eMc);
  Vector6 change;
  change << off.linear, off.angular;
  const Matrix6 expected = prediction.covariance + fit.result.covariance;
  diagnosis.innovation = std::sqrt(change.dot(expected.ldlt().solve(change)) / 6.0);
  if (!(diagnosis.innovation < most_innovation)) return "the fit is far from where the frames before put it";

  std::array<int, 2> tried{};
  std::array<int, 2> used{};
  for (const FittedFeature& f : fit.result.features) {
    const std::size_t group = f.name.ends_with("_ring") || f.name == "button" ? 0 : 1;
    tried[group] += f.sites_tried;
    used[group] += f.sites_used;
  }
  if (used[0] < least_group_share * tried[0]) return "the rings are not where the frame before puts them";
  if (used[1] < std::max<double>(least_lines, least_group_share * tried[1])) {
    return "the lines are not where the frame before puts them";
  }
  return {};
}

SheetTrack::SheetTrack(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
SheetTrack::~SheetTrack() = default;
SheetTrack::SheetTrack(SheetTrack&&) noexcept = default;
SheetTrack& SheetTrack::operator=(SheetTrack&&) noexcept = default;

const SheetFitResult& SheetTrack::begin(const cv::Mat& image, const SheetFitStart& start) {
  return impl_->begin(image, start);
}

const SheetFitResult& SheetTrack::follow(const cv::Mat& image, const SheetPrediction& prediction) {
  return impl_->follow(image, prediction);
}

const TrackDiagnosis& SheetTrack::diagnosis() const { return impl_->diagnosis; }

}  // namespace hogline::vision
