// What the drive adapter must be told. Physical numbers have no default: an unset one is refused by name.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// Which node, and what it must say it is.
struct NodeIdentity {
  std::string name;                ///< "left wheel"
  std::uint8_t node = 0;           ///< 1..127
  std::uint32_t vendor_id = 0;     ///< 1018:01
  std::uint32_t product_code = 0;  ///< 1018:02
};

/// Between an axis in the robot's sense (a wheel, pan, tilt) and its drive's integers. "motor" is before the gear.
struct AxisGearing {
  int direction = 0;          ///< +1 or -1: the drive's positive sense turns the axis this way or the other
  double gear_ratio = unset;  ///< motor revolutions per revolution of the axis
  double position_counts_per_motor_rev = unset;      ///< of 6064 and 607A
  double velocity_units_per_motor_rps = unset;       ///< of 60FF, 606C, 6081, for one revolution per second
  double acceleration_units_per_motor_rps2 = unset;  ///< of 6083, 6084, 6085, for one revolution per second squared
};

/// One wheel's drive node. "motor" is before the gear, "wheel" after it.
struct WheelConfig {
  std::string name;                ///< "left wheel"
  std::uint8_t node = 0;           ///< 1..127
  std::uint32_t vendor_id = 0;     ///< 1018:01
  std::uint32_t product_code = 0;  ///< 1018:02
  int direction = 0;               ///< +1 or -1: the drive's positive sense turns the wheel forward or backward
  double gear_ratio = unset;       ///< motor revolutions per wheel revolution
  double position_counts_per_motor_rev = unset;      ///< of 6064
  double velocity_units_per_motor_rps = unset;       ///< of 60FF and 606C, for one revolution per second
  double acceleration_units_per_motor_rps2 = unset;  ///< of 6085, for one revolution per second squared
  double max_speed_radps = unset;                    ///< of the wheel; a faster set-point is a fault
  double quick_stop_radps2 = unset;                  ///< of the wheel: the drive's quick-stop ramp
};

NodeIdentity identity(const WheelConfig& wheel);
AxisGearing gearing(const WheelConfig& wheel);

/// Deadlines. The defaults are those of doc/bus_maps.md for 200 Hz.
struct DriveTiming {
  Duration control_period = std::chrono::milliseconds{5};      ///< also 60C2; whole milliseconds
  Duration command_age_limit = std::chrono::milliseconds{15};  ///< a set-point older than this stops the robot
  Duration feedback_timeout = std::chrono::milliseconds{25};   ///< without a TPDO
  Duration rpdo_timeout = std::chrono::milliseconds{40};       ///< the drive's own watchdog over our RPDO
  Duration heartbeat_period = std::chrono::milliseconds{50};   ///< ours and the drives'
  Duration heartbeat_timeout = std::chrono::milliseconds{150};
  Duration sdo_timeout = std::chrono::milliseconds{100};
  Duration boot_timeout = std::chrono::seconds{5};          ///< until a node answers at all, and for each boot stage
  Duration state_timeout = std::chrono::milliseconds{500};  ///< for one CiA 402 transition
  Duration quick_stop_timeout = std::chrono::milliseconds{50};  ///< until quick stop active is reported
  Duration stop_margin = std::chrono::milliseconds{300};        ///< beyond the ramp's own time, until standstill
};

/// What an adapter sends for the whole bus. Exactly one does each: false where another adapter on the same bus, or the
/// kernel's timer (socketcan/bcm_cyclic.hpp), does it.
struct BusDuties {
  bool sync = true;
  bool heartbeat = true;
};

/// What is physically possible, at the axis.
struct DrivePlausibility {
  double standstill_radps = unset;       ///< slower is standing
  double speed_error_radps = unset;      ///< measured against commanded ...
  Duration speed_error_time{};           ///< ... for longer than this
  double position_mismatch_rad = unset;  ///< encoder position against integrated encoder speed, over 0.2 s
};

struct TwoWheelDriveConfig {
  WheelConfig left;
  WheelConfig right;
  std::uint8_t master_node = 0;  ///< 1..127, under which we send our heartbeat
  DriveTiming timing;
  DrivePlausibility plausibility;
  BusDuties duties{};
};

/// Why the configuration can not be used: key, value, and what is allowed. Nothing if it can.
std::optional<std::string> config_error(const TwoWheelDriveConfig& config);

}  // namespace hogline::hw
