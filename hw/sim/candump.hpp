// The text of `candump -L`: one received frame a line.
#pragma once

#include <string>
#include <string_view>

#include "hw/can_bus.hpp"

namespace hogline::hw::sim {

/// "(1795302065.451912) vcan0 601#4041600000000000", without the line end. The time is the stamp's, in microseconds;
/// a 29-bit identifier has eight digits, a remote frame reads "601#R".
std::string candump_line(const StampedCanFrame& received, std::string_view interface_name);

}  // namespace hogline::hw::sim
