// One camera, by looking at some of its pictures.
#pragma once

#include <optional>
#include <string>

#include "src/config/camera_source.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

/// `covered`: it is on the folded head, and darkness is what it must see.
Finding examine_camera(const std::string& name, const config::CameraSource& source, bool covered, Site& site);

}  // namespace hogline::doctor
