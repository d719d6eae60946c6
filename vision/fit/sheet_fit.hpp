// One robust joint fit of a camera's pose to every painted edge in view: virtual visual servoing (Gauss-Newton on the
// camera's twist) in the raw picture, through lens, response curve and ice refraction.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vision/camera_setup.hpp"

namespace hogline::vision {

/// How far off the start may be, and what else is known beforehand.
struct SheetFitStart {
  Pose eMc;                             ///< rough camera pose in e
  double search_px = 8.0;               ///< edges are looked for within this of where `eMc` puts them
  std::optional<double> sheet_width_m;  ///< a first guess of the width; empty: sidelines are not used at first
  double sheet_width_sigma_m = 0.02;    ///< of that guess, where it is given
  double roll_sigma_rad = 0.0;          ///< weak prior on the mount's roll, 0 for none
  double pitch_sigma_rad = 0.0;         ///< weak prior on the mount's pitch, 0 for none
  double pitch_offset_rad = 0.0;        ///< the prior's middle, from the mount's pitch; positive looks down more
  double height_sigma_m = 0.0;          ///< weak prior on the mount's height, 0 for none
  double most_sigma_m = 0.25;           ///< a place across or along the sheet less sure than this is none
  double travel_m = 0.0;                ///< of the camera along y during the exposure: motion blur to expect
  bool may_be_hidden = false;           ///< paint in pieces of the picture that bear none out is hidden, not missing
  double paint_depth_sigma_m = 0.0;     ///< prior on the setup's paint depth; 0: taken as given, else estimated too
};

/// A place where paint was looked for.
struct EdgeSite {
  Eigen::Vector2d pixel;     ///< where the fitted model puts it
  Eigen::Vector2d normal;    ///< unit, in the picture
  double residual_px = 0.0;  ///< found minus predicted along the normal
  double weight = 0.0;       ///< 0: not found, or an outlier
  int feature = 0;           ///< index into SheetFitResult::features
};

struct FittedFeature {
  std::string name;  ///< outer_ring, middle_ring, inner_ring, button, centre_line, hog_line, left_sideline, ...
  int sites_tried = 0;
  int sites_used = 0;
  int sites_hidden = 0;  ///< of those tried: where the picture bears out no paint at all round about
};

/// `ok == false` with a reason when too little was found or the fit is not determined.
struct SheetFitResult {
  bool ok = false;
  std::string reason;
  Pose eMc;
  Eigen::Matrix<double, 6, 6>
      covariance;  ///< of the camera's twist (translation first, c's axes), inflated by what the model can not know
  PlanarPose body;
  PlanarSigma sigma;
  double hog_distance_sigma_m = 0.0;
  std::optional<double> sheet_width_m;  ///< empty where no sideline pair was used
  double sheet_width_sigma_m = 0.0;
  double paint_depth_m = 0.0;  ///< as given, or as estimated
  double residual_px = 0.0;
  /// By how far all edges lie towards the darker side, as the residuals tell, and what that would move the body along
  /// y. About zero where the response curve is right; paint's edges wander with a wrong gamma.
  double bleed_px = 0.0;
  double bleed_sigma_px = 0.0;
  double bleed_y_m = 0.0;
  int sites_tried = 0;
  int sites_used = 0;
  int sites_hidden = 0;  ///< of those tried: somebody or something stands before them
  std::vector<FittedFeature> features;
  std::vector<EdgeSite> sites;
};

/// Reusable: keeps its buffers from call to call.
class SheetFit {
 public:
  explicit SheetFit(const CameraSetup& setup);
  ~SheetFit();
  SheetFit(SheetFit&&) noexcept;
  SheetFit& operator=(SheetFit&&) noexcept;

  /// `image` is CV_8UC3 (BGR) or CV_8UC1 in the camera's response curve, of the setup's size (else !ok).
  const SheetFitResult& fit(const cv::Mat& image, const SheetFitStart& start);

 private:
  friend class SheetTrack;  // follows what was fitted by the same steps
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
