// The camera's pose from the four points: EPnP, its reprojection error, and ViSP's virtual visual servoing.
#pragma once

#include <optional>

#include "vision/detect/four_points.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::vision {

struct PointPose {
  Pose eMc;
  double reprojection = 0.0;  ///< RMS, in plane units
};

/// EPnP (Lepetit 2009). Nothing when it yields no finite pose above the ice.
std::optional<PointPose> epnp(const FourPoints& points);

/// vpPose's virtual visual servoing from a first pose: EPnP alone is poor on noisy planar points.
/// Nothing when ViSP throws, or the result is not finite, or not above the ice.
std::optional<PointPose> refine_pose(const FourPoints& points, const Pose& eMc);

}  // namespace hogline::vision
