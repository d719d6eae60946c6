// The robust least-squares core of the joint fit: camera twist and, where sidelines are used, the sheet's width.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/fit/site_planner.hpp"

namespace hogline::vision {

/// A planned site at which paint was found.
struct Measurement {
  int site = 0;            ///< index into the planned sites
  double offset_px = 0.0;  ///< found less predicted along the normal, at the pose of the plan
  double sigma_px = 0.0;
  std::array<float, 3> contrast{};
  double weight = 0.0;       ///< robust, 0 for an outlier
  double residual_px = 0.0;  ///< after the last solve
};

/// Weak knowledge of the mount, against which roll, pitch and height may pull; 0 for none.
struct MountPrior {
  double roll_sigma_rad = 0.0;
  double pitch_sigma_rad = 0.0;
  double height_sigma_m = 0.0;
};

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// A linear step about the plan's pose: the camera's twist (ViSP's order) and the change of the sheet's width in m.
struct Solution {
  bool ok = false;
  Vector7 step = Vector7::Zero();
  Matrix7 information = Matrix7::Zero();  ///< with each site's own noise: the step's weights
  Matrix7 covariance = Matrix7::Zero();   ///< of the step, with errors that sites of one feature share
  double scale_px = 0.0;                  ///< robust standard deviation of the residuals
};

/// Iteratively reweighted (Tukey). Sets weight and residual_px of each measurement. `free_width`: the seventh unknown.
Solution solve(const std::vector<PaintedFeature>& features, const std::vector<PlannedSite>& sites,
               std::vector<Measurement>& measurements, const Pose& eMc, const Mount& mount, const MountPrior& prior,
               bool free_width);

}  // namespace hogline::vision
