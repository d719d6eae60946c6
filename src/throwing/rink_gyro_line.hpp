// The simulated rink's gyro as a line of bytes.
#pragma once

#include "hw/byte_line.hpp"
#include "hw/sim/rink.hpp"

namespace hogline {

class RinkGyroLine final : public hw::ByteLine {
 public:
  explicit RinkGyroLine(hw::sim::Rink& rink) : rink_(rink) {}
  std::optional<std::string> open() override { return std::nullopt; }
  void close() override {}
  std::optional<std::string> read() override { return rink_.read_gyro(); }
  bool write(std::string_view bytes) override {
    rink_.gyro().write(bytes);
    return true;
  }

 private:
  hw::sim::Rink& rink_;
};

}  // namespace hogline
