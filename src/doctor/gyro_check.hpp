// The gyro, by listening.
#pragma once

#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

Finding examine_gyro(const hw::Dsp3000Config& config, Site& site);

}  // namespace hogline::doctor
