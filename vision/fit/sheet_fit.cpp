#include "vision/fit/sheet_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "vision/edges/locate.hpp"
#include "vision/edges/profile.hpp"
#include "vision/fit/fit_solver.hpp"
#include "vision/fit/painted_features.hpp"
#include "vision/fit/site_planner.hpp"

namespace hogline::vision {
namespace {

constexpr double blur_px = 1.0;  // lens, demosaicing and the pixel itself
constexpr int fewest_sites = 24;
constexpr double worst_residual_px = 1.0;

struct Stage {
  double search_px;
  double spacing_px;
  bool coarse_only;
};

}  // namespace

struct SheetFit::Impl {
  explicit Impl(const CameraSetup& camera_setup)
      : setup(camera_setup),
        response(camera_setup.gamma),
        features(fixed_features()),
        camera(Lens(setup.intrinsics), start_pose(), setup.ice) {}

  Pose start_pose() const { return eMb(PlanarPose{}) * bMc(setup.mount); }

  void run(const cv::Mat& image, const SheetFitStart& start);
  bool stage(const ProfileReader& reader, const Stage& stage, const MountPrior& prior);
  void measure(const ProfileReader& reader, const Stage& stage);
  void drop_foreign_contrast();
  void report();
  PlanarSigma planar_sigma(const Eigen::Matrix<double, 6, 6>& covariance) const;
  void refuse(std::string reason) {
    result.ok = false;
    result.reason = std::move(reason);
  }

  CameraSetup setup;
  ResponseCurve response;
  std::vector<PaintedFeature> features;
  SheetCamera camera;
  std::optional<double> width_m;
  std::vector<PlannedSite> sites;
  std::vector<Measurement> measurements;
  Solution solution;
  SheetFitResult result;
};

SheetFit::SheetFit(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
SheetFit::~SheetFit() = default;
SheetFit::SheetFit(SheetFit&&) noexcept = default;
SheetFit& SheetFit::operator=(SheetFit&&) noexcept = default;

const SheetFitResult& SheetFit::fit(const cv::Mat& image, const SheetFitStart& start) {
  impl_->run(image, start);
  return impl_->result;
}

void SheetFit::Impl::run(const cv::Mat& image, const SheetFitStart& start) {
  result = SheetFitResult{};
  const bool right_type = image.type() == CV_8UC3 || image.type() == CV_8UC1;
  if (image.cols != setup.intrinsics.width_px || image.rows != setup.intrinsics.height_px || !right_type) {
    return refuse("the picture is not of the camera's size, or not 8 bits a channel");
  }
  if (!is_finite(start.eMc) || start.eMc.translation().z() <= 0.0)
    return refuse("the start is not a pose above the ice");

  camera.move_to(start.eMc);
  width_m = start.sheet_width_m;
  features = fixed_features();
  if (width_m) {
    features.push_back(sideline(PaintedFeature::Place::left_sideline, *width_m));
    features.push_back(sideline(PaintedFeature::Place::right_sideline, *width_m));
  }
  const ProfileReader reader(image, response);
  const MountPrior prior{start.roll_sigma_rad, start.pitch_sigma_rad, start.height_sigma_m};
  const double coarse_px = std::clamp(start.search_px, 3.0, 25.0);
  const Stage stages[] = {{coarse_px, 10.0, true},
                          {std::max(3.0, 0.4 * coarse_px), 10.0, false},
                          {3.0, 8.0, false},
                          {2.0, 6.0, false},
                          {2.0, 6.0, false}};
  for (const Stage& s : stages) {
    if (!stage(reader, s, prior)) return;
  }
  report();
}

bool SheetFit::Impl::stage(const ProfileReader& reader, const Stage& stage, const MountPrior& prior) {
  plan_sites(features, camera,
             {.spacing_px = stage.spacing_px,
              .search_px = stage.search_px,
              .blur_px = blur_px,
              .coarse_only = stage.coarse_only},
             sites);
  measure(reader, stage);
  drop_foreign_contrast();
  if (static_cast<int>(measurements.size()) < fewest_sites) {
    refuse("too little paint found where it was expected");
    return false;
  }
  solution = solve(features, sites, measurements, camera.eMc(), setup.mount, prior, width_m.has_value());
  if (!solution.ok) {
    refuse("the paint found does not determine the pose");
    return false;
  }
  const Pose moved = camera.eMc() * exp(Twist{solution.step.head<3>(), solution.step.segment<3>(3)});
  if (!is_finite(moved) || moved.translation().z() <= 0.05 || solution.step.head<6>().norm() > 1.0) {
    refuse("the fit ran away from its start");
    return false;
  }
  camera.move_to(moved);
  if (width_m) {
    *width_m += solution.step(6);
    for (PaintedFeature& f : features) {
      if (f.place != PaintedFeature::Place::fixed) f = sideline(f.place, *width_m);
    }
  }
  return true;
}

void SheetFit::Impl::measure(const ProfileReader& reader, const Stage& stage) {
  measurements.clear();
  Profile profile;
  for (int i = 0; i < static_cast<int>(sites.size()); ++i) {
    const PlannedSite& site = sites[static_cast<std::size_t>(i)];
    const double reach_px = stage.search_px + 3.5 * blur_px + 1.5 * site.line_width_px + 1.0;
    if (!reader.read(site.pixel, site.normal, reach_px, profile)) continue;
    const Localisation found = site.line_width_px > 0.0
                                   ? locate_line(profile, stage.search_px, site.line_width_px, blur_px)
                                   : locate_edge(profile, stage.search_px, blur_px);
    if (!found.ok) continue;
    measurements.push_back(
        {.site = i, .offset_px = found.offset_px, .sigma_px = found.sigma_px, .contrast = found.contrast});
  }
}

// Paint keeps its colour along a feature; what differs from it is somebody's shoe, a stone, a lamp's reflection.
void SheetFit::Impl::drop_foreign_contrast() {
  constexpr float most_different = 0.7F;  // cosine
  std::vector<Eigen::Vector3f> usual(2 * features.size(), Eigen::Vector3f::Zero());
  const auto slot = [this](const Measurement& m) {
    const PlannedSite& site = sites[static_cast<std::size_t>(m.site)];
    const PaintedFeature& f = features[static_cast<std::size_t>(site.feature)];
    // A wide line's two edges have opposite contrast.
    const bool far_side = f.width_m > 0.0 && site.line_width_px == 0.0 && towards(f, site.paint).sum() < 0.0;
    return 2 * static_cast<std::size_t>(site.feature) + (far_side ? 1U : 0U);
  };
  const auto unit = [](const Measurement& m) {
    return Eigen::Vector3f(m.contrast[0], m.contrast[1], m.contrast[2]).normalized();
  };
  for (const Measurement& m : measurements) usual[slot(m)] += unit(m);
  std::erase_if(measurements, [&](const Measurement& m) {
    const Eigen::Vector3f& sum = usual[slot(m)];
    return sum.norm() <= 0.0F || unit(m).dot(sum.normalized()) < most_different;
  });
}

void SheetFit::Impl::report() {
  result.eMc = camera.eMc();
  result.covariance = solution.covariance.topLeftCorner<6, 6>();
  result.body = planar_body(result.eMc, setup.mount);
  result.sigma = planar_sigma(result.covariance);
  result.hog_distance_sigma_m = result.sigma.y_m;
  result.features.clear();
  for (const PaintedFeature& f : features) result.features.push_back({.name = f.name});
  for (const PlannedSite& site : sites) ++result.features[static_cast<std::size_t>(site.feature)].sites_tried;
  double sum = 0.0;
  for (const Measurement& m : measurements) {
    const PlannedSite& site = sites[static_cast<std::size_t>(m.site)];
    result.sites.push_back({.pixel = site.pixel,
                            .normal = site.normal,
                            .residual_px = m.residual_px,
                            .weight = m.weight,
                            .feature = site.feature});
    if (m.weight <= 0.0) continue;
    ++result.features[static_cast<std::size_t>(site.feature)].sites_used;
    ++result.sites_used;
    sum += m.residual_px * m.residual_px;
  }
  result.sites_tried = static_cast<int>(sites.size());
  result.residual_px = std::sqrt(sum / std::max(1, result.sites_used));
  if (width_m) {
    result.sheet_width_m = width_m;
    result.sheet_width_sigma_m = std::sqrt(solution.covariance(6, 6));
  }
  result.ok = result.sites_used >= fewest_sites && result.residual_px < worst_residual_px;
  if (!result.ok) result.reason = "too little paint agrees with the fitted pose";
}

PlanarSigma SheetFit::Impl::planar_sigma(const Eigen::Matrix<double, 6, 6>& covariance) const {
  constexpr double delta = 1e-6;
  Eigen::Matrix<double, 3, 6> by_twist;
  for (int i = 0; i < 6; ++i) {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step(i) = delta;
    const Twist twist{step.head<3>(), step.tail<3>()};
    const PlanarPose plus = planar_body(camera.eMc() * exp(twist), setup.mount);
    const PlanarPose minus = planar_body(camera.eMc() * exp(Twist{-twist.linear, -twist.angular}), setup.mount);
    by_twist.col(i) << plus.x_m - minus.x_m, plus.y_m - minus.y_m, wrapped(plus.yaw_rad - minus.yaw_rad);
  }
  by_twist /= 2.0 * delta;
  const Eigen::Matrix3d planar = by_twist * covariance * by_twist.transpose();
  return {.x_m = std::sqrt(planar(0, 0)), .y_m = std::sqrt(planar(1, 1)), .yaw_rad = std::sqrt(planar(2, 2))};
}

}  // namespace hogline::vision
