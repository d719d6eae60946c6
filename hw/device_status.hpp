// How every device port says whether it can be trusted.
#pragma once

#include <optional>
#include <string>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// Errors grouped by what the caller does about them.
enum class DeviceErrorKind {
  timeout,       ///< no answer, or no news, within the deadline: the device may be gone
  disconnected,  ///< the transport is down; the adapter reconnects by itself, but nothing moves until re-armed
  protocol,      ///< an answer that the standard forbids, or that belongs to another command
  refused,       ///< the device understood and said no
  device_fault,  ///< the device reports a fault of its own
  implausible,   ///< values outside what is physically possible
};

/// The name of a kind, for logs and reasons.
constexpr const char* to_string(DeviceErrorKind kind) {
  switch (kind) {
    case DeviceErrorKind::timeout:
      return "timeout";
    case DeviceErrorKind::disconnected:
      return "disconnected";
    case DeviceErrorKind::protocol:
      return "protocol";
    case DeviceErrorKind::refused:
      return "refused";
    case DeviceErrorKind::device_fault:
      return "device fault";
    case DeviceErrorKind::implausible:
      return "implausible";
  }
  return "unknown";
}

/// A latched device error. It stays in the device's state until the device is re-armed.
struct DeviceError {
  DeviceErrorKind kind = DeviceErrorKind::timeout;
  std::string device;  ///< "left wheel (node 1)", "gripper", ...
  std::string what;    ///< what happened and, where known, what to check
  Stamp since{};
};

}  // namespace hogline::hw
