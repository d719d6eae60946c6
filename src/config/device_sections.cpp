#include "src/config/device_sections.hpp"

#include "src/config/config_error.hpp"

namespace hogline::config {

hw::ModbusSessionConfig read_modbus(const Section& s, const Document& document) {
  if (s.has("tcp") == s.has("rtu")) {
    throw ConfigError(document.file, document.line_of("modbus"), "modbus", "", "must hold either tcp or rtu");
  }
  hw::ModbusSessionConfig m;
  if (s.has("tcp")) {
    m.line.line = hw::ModbusTcp{.address = s.section("tcp").word("address"), .port = s.section("tcp").integer("port")};
  } else {
    const Section r = s.section("rtu");
    m.line.line = hw::ModbusRtu{.device = r.word("device"),
                                .baud = r.integer("baud"),
                                .parity = r.word("parity").front(),
                                .data_bits = r.integer("data_bits"),
                                .stop_bits = r.integer("stop_bits")};
  }
  m.line.response_timeout = s.duration("response_timeout_s");
  m.reconnect_delay = s.duration("reconnect_delay_s");
  return m;
}

hw::AxisConfig read_axis(const Section& s) {
  return {.unit = s.integer("unit"),
          .poll_period = s.duration("poll_period_s"),
          .echo_deadline = s.duration("echo_deadline_s"),
          .silence_limit = s.duration("silence_limit_s")};
}

hw::ModbusGripperConfig read_gripper(const Section& s) {
  hw::ModbusGripperConfig g;
  g.jaws = {.unit = s.integer("unit"),
            .poll_period = s.duration("poll_period_s"),
            .echo_deadline = s.duration("echo_deadline_s"),
            .activation_deadline = s.duration("activation_deadline_s"),
            .silence_limit = s.duration("silence_limit_s"),
            .close_speed = static_cast<std::uint8_t>(s.integer("close_speed")),
            .close_force = static_cast<std::uint8_t>(s.integer("close_force")),
            .freeing_travel = s.integer("freeing_travel")};
  g.belt = read_axis(s.section("belt"));
  g.max_spin_radps = s.number("max_spin_radps");
  return g;
}

hw::Dsp3000Config read_gyro_device(const Section& s) {
  const Section rest = s.section("rest");
  return {.variant = s.word("variant") == "text" ? hw::Dsp3000Variant::text : hw::Dsp3000Variant::binary,
          .sign = s.number("sign"),
          .latitude_rad = s.radians("latitude_deg"),
          .latency = s.duration("latency_s"),
          .silence_limit = s.duration("silence_limit_s"),
          .mode_deadline = s.duration("mode_deadline_s"),
          .reopen_delay = s.duration("reopen_delay_s"),
          .max_rate_radps = s.radians("max_rate_degps"),
          .max_slew_radps2 = s.radians("max_slew_degps2"),
          .stuck_limit = s.duration("stuck_limit_s"),
          .rest_window = rest.duration("window_s"),
          .max_bias_radps = rest.radians("max_bias_degps"),
          .max_bias_step_radps = rest.radians("max_bias_step_degps")};
}

hw::SerialPortConfig read_gyro_port(const Section& s) {
  return {.device = s.word("device"), .baud = s.word("variant") == "text" ? 38400 : 115200};
}

}  // namespace hogline::config
