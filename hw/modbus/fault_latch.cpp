#include "hw/modbus/fault_latch.hpp"

#include <utility>

namespace hogline::hw {

FaultLatch::FaultLatch(std::string device, Duration silence_limit)
    : device_(std::move(device)), silence_limit_(silence_limit) {}

void FaultLatch::poll_failed(const ModbusFault& fault, Stamp now) {
  if (!last_success_) last_success_ = now;
  if (now - *last_success_ > silence_limit_) latch(fault.kind, fault.what, now);
}

void FaultLatch::latch(DeviceErrorKind kind, const std::string& what, Stamp now) {
  if (!error_) error_ = DeviceError{kind, device_, what, now};
}

void FaultLatch::rearm() {
  error_.reset();
  last_success_.reset();
}

}  // namespace hogline::hw
