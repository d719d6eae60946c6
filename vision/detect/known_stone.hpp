// A stone that is known already, and may hide parts of others.
#pragma once

#include <Eigen/Core>

namespace hogline::vision {

struct KnownStone {
  Eigen::Vector2d place;                             ///< in e
  Eigen::Vector3d handle = Eigen::Vector3d::Zero();  ///< its colour against white ice: blue, green, red
};

}  // namespace hogline::vision
