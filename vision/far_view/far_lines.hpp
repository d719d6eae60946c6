// Where the far picture's lines are, roughly: how the camera is panned and tilted against its plan, by a vote of thin
// dark lines of the right width. A turn of the camera moves the whole picture, so that a line found anywhere speaks for
// all pans and tilts that would put it there.
#pragma once

#include <vector>

#include "vision/fit/site_measurement.hpp"
#include "vision/fit/site_planner.hpp"

namespace hogline::vision {

/// Axes of the head in e, as columns: forward and level, to the left, up. Roll, tilt and pan turn about them.
Eigen::Matrix3d head_axes(const Pose& eMc);

struct LineVoteRange {
  double pan_sigma_rad = 0.0;
  double tilt_sigma_rad = 0.0;
};

struct LineVote {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  double agreement = 0.0;  ///< share of the looked-for places that agree, the features' mean
  int places = 0;          ///< at which something like the line was seen at all
};

/// Keeps its memory from picture to picture.
class LineVoter {
 public:
  /// `sites` are planned where the lines would be by the plan's pose `eMc`; rings and wide edges among them are not
  /// used. Looks three sigmas either way.
  LineVote find(const PictureLight& light, const Pose& eMc, const std::vector<PlannedSite>& sites,
                const LineVoteRange& range);

 private:
  /// A line seen at one site: so far from the prediction along its normal.
  struct Sight {
    double offset_px;
    float strength;
  };
  struct Grid;
  void look(const PictureLight& light, const PlannedSite& site, double reach_px);

  Profile profile_;
  std::vector<std::array<float, 3>> cut_;
  std::vector<Sight> sights_;
  std::vector<float> drop_;
  std::vector<float> votes_;
};

}  // namespace hogline::vision
