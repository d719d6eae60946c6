#include "hw/sim/candump.hpp"

#include <algorithm>
#include <cstdio>

namespace hogline::hw::sim {

std::string candump_line(const StampedCanFrame& received, std::string_view interface_name) {
  const CanFrame& frame = received.frame;
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(received.stamp.time_since_epoch()).count();

  char text[32];
  std::snprintf(text, sizeof text, "(%010lld.%06lld) ", static_cast<long long>(us / 1000000),
                static_cast<long long>(us % 1000000));
  std::string line = text;
  line.append(interface_name);
  std::snprintf(text, sizeof text, frame.extended ? " %08X#" : " %03X#", unsigned{frame.id});
  line += text;
  if (frame.remote) return line + "R";
  for (int i = 0; i < std::min<int>(frame.length, 8); ++i) {
    std::snprintf(text, sizeof text, "%02X", unsigned{frame.data[static_cast<std::size_t>(i)]});
    line += text;
  }
  return line;
}

}  // namespace hogline::hw::sim
