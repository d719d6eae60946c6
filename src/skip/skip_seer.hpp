// Who sees what the skip's cameras show: vision, or on the simulated rink an oracle.
#pragma once

#include "hw/camera.hpp"
#include "servo/skip.hpp"

namespace hogline {

class SkipSeer {
 public:
  virtual ~SkipSeer() = default;
  /// `q`: the head's angles at the frame's exposure; `known`: what the skip knows now. The frame's stamp becomes the
  /// percept's.
  virtual servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                                     const servo::SkipDiagnosis& known) = 0;
  virtual FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q,
                              const servo::SkipDiagnosis& known) = 0;
};

}  // namespace hogline
