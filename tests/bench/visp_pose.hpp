// From Eigen's poses to ViSP's and back, checked. C++17, as ViSP 3.5's headers want it.
#pragma once

#include <visp3/core/vpHomogeneousMatrix.h>

#include "vision/geometry/pose.hpp"

namespace hogline::bench {

inline vpHomogeneousMatrix to_visp(const vision::Pose& pose) {
  vpHomogeneousMatrix m;
  for (unsigned r = 0; r < 3; ++r) {
    for (unsigned c = 0; c < 4; ++c) m[r][c] = pose.matrix()(static_cast<int>(r), static_cast<int>(c));
  }
  return m;
}

/// NaN stays NaN: ViSP does not always say when it fails, so ask vision::is_finite().
inline vision::Pose from_visp(const vpHomogeneousMatrix& m) {
  vision::Pose pose = vision::Pose::Identity();
  for (unsigned r = 0; r < 3; ++r) {
    for (unsigned c = 0; c < 4; ++c) pose.matrix()(static_cast<int>(r), static_cast<int>(c)) = m[r][c];
  }
  return pose;
}

}  // namespace hogline::bench
