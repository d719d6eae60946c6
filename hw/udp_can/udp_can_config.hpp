// Where a CAN bus over UDP is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hogline::hw {

struct UdpCanConfig {
  std::string group = "239.74.163.2";  ///< an IPv4 multicast address; python-can's default
  std::uint16_t port = 43113;          ///< python-can's default
  /// The only network interface that is spoken and listened on. Datagrams never leave the machine or its own network:
  /// their time to live is 0 on `lo` and 1 elsewhere.
  std::string interface = "lo";
};

/// Why the configuration can not be used; nothing if it can.
std::optional<std::string> config_error(const UdpCanConfig& config);

}  // namespace hogline::hw
