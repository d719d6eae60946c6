// The latched error of one device behind a shared connection.
#pragma once

#include "hw/modbus/modbus_transport.hpp"

namespace hogline::hw {

/// Forgives failed polls for a while; latches the first error that is not forgiven until rearm().
class FaultLatch {
 public:
  /// A failed poll is an error when none has succeeded for longer than `silence_limit`. The state's stamp ages
  /// meanwhile.
  FaultLatch(std::string device, Duration silence_limit);

  void poll_succeeded(Stamp now) { last_success_ = now; }
  void poll_failed(const ModbusFault& fault, Stamp now);
  void latch(DeviceErrorKind kind, const std::string& what, Stamp now);
  void rearm();
  const std::optional<DeviceError>& error() const { return error_; }

 private:
  std::string device_;
  Duration silence_limit_;
  std::optional<Stamp> last_success_;  ///< or the first failure after the start or rearm()
  std::optional<DeviceError> error_;
};

}  // namespace hogline::hw
