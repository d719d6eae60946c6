// What the low view's single frames and its sequences share: what they know of the mount, and what they say of a fit.
#pragma once

#include <string>

#include "vision/camera_setup.hpp"
#include "vision/detect/h_level.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

/// How far the running body's camera may be from its mount beside its lean (lean_sigma_rad): one standard deviation.
namespace low_mount {
inline constexpr double roll_sigma_rad = 0.0017;
inline constexpr double height_sigma_m = 0.003;
}  // namespace low_mount

/// Why the camera can not be where a fit puts it; empty when it can.
std::string doubt_of_mount(const Pose& eMc, const CameraSetup& setup);

/// Why the picture's response curve can not be the setup's; empty when it can.
std::string doubt_of_response(const SheetFitResult& result);

/// All but the stamp. Sigmas are the fit's and what sidelines that are not laid quite parallel do to the lean.
void fill_low_percept(const SheetFitResult& result, const CameraSetup& setup, SheetPosePercept& percept);

}  // namespace hogline::vision
