// CAN frames as candump writes them, so that golden traces can be copied into tests as they are.
#pragma once

#include <cstdlib>
#include <string>

#include "hw/can_bus.hpp"

namespace hogline::hw::test {

/// "601#4041600000000000" as a frame.
inline CanFrame frame(const std::string& text) {
  const std::size_t hash = text.find('#');
  CanFrame result{.id = static_cast<std::uint32_t>(std::strtoul(text.substr(0, hash).c_str(), nullptr, 16)),
                  .data = {}};
  for (std::size_t i = hash + 1; i + 1 < text.size(); i += 2) {
    result.data[result.length++] = static_cast<std::uint8_t>(std::strtoul(text.substr(i, 2).c_str(), nullptr, 16));
  }
  return result;
}

/// A frame as "601#4041600000000000".
inline std::string text(const CanFrame& frame) {
  char digits[8];
  std::snprintf(digits, sizeof digits, "%03X#", unsigned{frame.id});
  std::string result = digits;
  for (std::size_t i = 0; i < frame.length; ++i) {
    std::snprintf(digits, sizeof digits, "%02X", unsigned{frame.data[i]});
    result += digits;
  }
  return result;
}

}  // namespace hogline::hw::test
