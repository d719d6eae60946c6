// Pictures that are taken together as one robot's that stands still: whether they can be.
#pragma once

#include <optional>
#include <string>

#include "vision/percepts/sheet_pose.hpp"

namespace hogline {

/// Compares where each picture says that the body is with what the first said. Allowed is what a robot on ice rocks,
/// 20 mm and 0.1 degrees, and six standard deviations of either picture beside it.
class StandingStill {
 public:
  /// `sheet.ok`. Why this picture can not be of the same standstill, for a person; empty where it can. The first
  /// picture says where that is.
  std::string contradiction(const std::string& name, const SheetPosePercept& sheet);

 private:
  struct First {
    std::string name;
    PlanarPose body;
    PlanarSigma sigma;
  };
  std::optional<First> first_;
};

}  // namespace hogline
