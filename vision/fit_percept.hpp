// From a fit to what is handed on.
#pragma once

#include "vision/fit/sheet_fit.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

/// All but the stamp; the names of the features that were used are appended to those already there. Allocates nothing
/// once the percept has held as many features.
void fill_percept(const SheetFitResult& result, SheetPosePercept& percept);

}  // namespace hogline::vision
