// Rig files: any text is a rig, or refused with a ConfigError that says something.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "src/config/config_error.hpp"
#include "src/config/thrower_rig.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using hogline::fuzz::require;
  try {
    const auto rig = hogline::config::parse_thrower_rig({reinterpret_cast<const char*>(data), size}, "rig.yaml");
    require(rig.drive.left.node != rig.drive.right.node, "two wheels are two nodes");
    require(rig.gripper.jaws.unit >= 1 && rig.gripper.jaws.unit <= 247, "a unit is 1..247");
    require(rig.modbus.line.response_timeout.count() > 0, "a timeout is positive");
    require(std::abs(rig.gyro.sign) == 1.0, "a sign is 1 or -1");
  } catch (const hogline::config::ConfigError& error) {
    require(*error.what() != '\0', "a refusal has words");
  }
  return 0;
}
