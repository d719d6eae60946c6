#include "src/throwing/fault.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hogline {

const std::vector<std::string>& fault_names() {
  static const std::vector<std::string> names{"drive-heartbeat",  "drive-dies",       "camera-freeze",  "camera-stops",
                                              "camera-black",     "camera-saturated", "camera-repeats", "camera-late",
                                              "camera-time-back", "modbus-stop",      "modbus-stall",   "gyro-silent",
                                              "gyro-invalid",     "can-down",         "jaws-slip",      "jaws-open"};
  return names;
}

std::optional<Fault> parse_fault(std::string_view text) {
  const auto at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto& names = fault_names();
  const auto name = std::find(names.begin(), names.end(), text.substr(0, at));
  const std::string_view number = text.substr(at + 1);
  double run_time_s = 0.0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), run_time_s);
  const bool whole = parsed.ec == std::errc{} && parsed.ptr == number.data() + number.size();
  if (name == names.end() || !whole || !std::isfinite(run_time_s) || run_time_s < 0.0) return std::nullopt;
  return Fault{static_cast<FaultKind>(name - names.begin()), run_time_s};
}

void inject(FaultKind kind, SimulatedRobot& robot) {
  using hw::sim::RenderedCamera;
  hw::sim::Rink& rink = robot.rink();
  switch (kind) {
    case FaultKind::drive_heartbeat:
      rink.left_drive().communication().faults.heartbeat_stopped = true;
      break;
    case FaultKind::drive_dies:
      rink.left_drive().kill(hw::sim::AxisPower::braked);
      break;  // its spring-applied brake falls in
    case FaultKind::camera_freeze:
      robot.low_camera().inject(RenderedCamera::Fault::frozen);
      break;
    case FaultKind::camera_stops:
      robot.low_camera().inject(RenderedCamera::Fault::stopped);
      break;
    case FaultKind::camera_black:
      robot.low_camera().inject(RenderedCamera::Fault::black);
      break;
    case FaultKind::camera_saturated:
      robot.low_camera().inject(RenderedCamera::Fault::saturated);
      break;
    case FaultKind::camera_repeats:
      robot.low_camera().inject(RenderedCamera::Fault::repeated);
      break;
    case FaultKind::camera_late:
      robot.low_camera().inject(RenderedCamera::Fault::late);
      break;
    case FaultKind::camera_time_back:
      robot.low_camera().inject(RenderedCamera::Fault::time_back);
      break;
    case FaultKind::modbus_stop:
      rink.modbus().stop();
      break;
    case FaultKind::modbus_stall:
      rink.modbus().stall();
      break;
    case FaultKind::gyro_silent:
      rink.gyro().set_silent(true);
      break;
    case FaultKind::gyro_invalid:
      rink.gyro().set_valid(false);
      break;
    case FaultKind::can_down:
      rink.bus().set_up(false);
      break;
    case FaultKind::jaws_slip:
      rink.modbus().inject([](auto& jaws, auto&, auto&) { jaws.lose_stone(); });
      break;
    case FaultKind::jaws_open:
      rink.modbus().inject([](auto& jaws, auto&, auto&) { jaws.give_way(); });
      break;
  }
}

}  // namespace hogline
