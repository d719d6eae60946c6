// The gyro, by listening; its adapter asks it for rate mode, as before a throw.
#pragma once

#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

Finding examine_gyro(Site& site);

}  // namespace hogline::doctor
