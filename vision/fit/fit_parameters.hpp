// What the joint fit estimates, in one vector.
#pragma once

#include <Eigen/Core>
#include <array>

#include "vision/geometry/pose.hpp"

namespace hogline::vision {

/// Places in the vector of changes: the camera's twist (translation first, c's axes), the sidelines, the ice.
namespace parameter {
inline constexpr int twist = 0;
inline constexpr int left_edge = 6;    ///< distance of the left sideline's inner edge from the centre line, metres
inline constexpr int left_paint = 7;   ///< its paint's width, metres
inline constexpr int right_edge = 8;   ///< the same of the right one
inline constexpr int right_paint = 9;  ///< the same of the right one
inline constexpr int depth = 10;       ///< of the paint under the ice, metres
inline constexpr int count = 11;
}  // namespace parameter

using ParameterRow = Eigen::Matrix<double, 1, parameter::count>;
using ParameterVector = Eigen::Matrix<double, parameter::count, 1>;
using ParameterMatrix = Eigen::Matrix<double, parameter::count, parameter::count>;

/// What is known of one sideline.
struct Sideline {
  bool known = false;
  bool is_line = true;       ///< false: the foot of a divider on the surface, one edge
  double edge_m = 0.0;       ///< of the inner edge, from the centre line, > 0
  double paint_m = 0.03;     ///< width of the paint
  bool moves_camera = true;  ///< false: its place is measured, but it does not tell where the camera is
};

/// The estimate: changes apply to it.
struct FitState {
  Pose eMc = Pose::Identity();
  std::array<Sideline, 2> sidelines;  ///< left, right
  double paint_depth_m = 0.0;
};

/// The state after a change.
FitState moved(const FitState& state, const ParameterVector& change);

}  // namespace hogline::vision
