// How the far camera looks, from what its picture shows of the sheet: lines across, centre line, sidelines and rings
// through lens and ice, in one robust fit with the plan as its prior.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/far_view/far_lines.hpp"
#include "vision/far_view/far_plan.hpp"
#include "vision/fit/joint_solver.hpp"
#include "vision/percepts/far_look.hpp"

namespace hogline::vision {

using CameraCovariance = Eigen::Matrix<double, 6, 6>;

/// `ok == false` with a reason when the picture does not determine how the camera looks, or contradicts the plan.
struct FarAim {
  bool ok = false;
  std::string reason;
  Pose eMc;
  FarCorrection correction;
  CameraCovariance covariance = CameraCovariance::Zero();  ///< of place (x, y, z) and turn about e's axes
  std::array<Sideline, 2> sidelines;                       ///< left, right, where they were found
  double residual_px = 0.0;
  int sites_used = 0;
  int sites_tried = 0;
  std::vector<std::string> features;
};

/// Keeps its memory from picture to picture.
class FarSheet {
 public:
  explicit FarSheet(const CameraSetup& setup);

  /// From the plan alone, which may be off by three of its sigmas.
  const FarAim& find(const PictureLight& light, const FarPlan& plan);

  /// From the plan as the last picture corrected it; `plan`'s sigmas are of what may have changed since.
  /// Precondition: the last aim was ok.
  const FarAim& follow(const PictureLight& light, const FarPlan& plan);

  const FarAim& aim() const { return aim_; }

 private:
  /// A look and a step. `floor_px` is the error that each place may still have: with too little, the lines that are off
  /// most would be taken for somebody else's.
  struct Round {
    double spacing_px;
    double search_px;
    int half_breadth;
    double floor_px;
  };
  void begin(const FarPlan& plan);
  bool vote(const PictureLight& light);
  void find_sidelines(const PictureLight& light);
  void look(const PictureLight& light, const Round& round);
  void solve(double floor_px, const ParameterVector& start);
  bool settle(const PictureLight& light, const Round& round);
  bool move();
  Prior prior() const;
  Eigen::Vector3d turned() const;
  const FarAim& judge();
  std::string refusal() const;
  std::string contradiction() const;
  const FarAim& refuse(std::string reason);

  CameraSetup setup_;
  Lens lens_;
  LineVoter voter_;
  FarPlan plan_;
  FitState state_;
  std::vector<PlannedSite> sites_;
  std::vector<SiteMeasurement> found_;
  CloseStep step_;
  std::vector<double> scratch_;
  std::vector<double> own_floor_px_;
  double spacing_px_ = 0.0;  ///< of the places that follow() looks at
  Profile profile_;
  FarAim aim_;
};

/// The pose turned by the correction about its own head's axes.
Pose corrected(const Pose& eMc, const FarCorrection& correction);

}  // namespace hogline::vision
