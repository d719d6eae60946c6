// The simulated rink's gyro as a line of bytes.
#pragma once

#include "hw/byte_line.hpp"
#include "hw/sim/rink.hpp"

namespace hogline {

class RinkGyroLine final : public hw::ByteLine {
 public:
  explicit RinkGyroLine(hw::sim::Rink& rink) : rink_(rink) {}
  std::optional<std::string> open() override {
    if (unplugged_) return "no such device";
    return std::nullopt;
  }
  void close() override {}
  std::optional<std::string> read() override {
    if (unplugged_) return std::nullopt;
    return rink_.read_gyro();
  }
  bool write(std::string_view bytes) override {
    if (unplugged_) return false;
    rink_.gyro().write(bytes);
    return true;
  }
  /// Fault injection: the serial adapter is gone, or has another name.
  void unplug(bool unplugged) { unplugged_ = unplugged; }

 private:
  hw::sim::Rink& rink_;
  bool unplugged_ = false;
};

}  // namespace hogline
