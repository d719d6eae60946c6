// Why a serial port can not be used, as the machine's files tell.
#pragma once

#include <string>

#include "src/doctor/finding.hpp"

namespace hogline::doctor {

/// Adds what is wrong with this path: missing, no serial port, no right to it. Nothing where it could be opened.
void describe_serial_device(const std::string& path, Finding& finding);

}  // namespace hogline::doctor
