// Where the doctor works: the lines of one robot, on steel or on the simulated rink, and the time that passes there.
#pragma once

#include <string>

#include "hw/camera.hpp"
#include "hw/can_bus.hpp"
#include "hw/gyro.hpp"
#include "hw/modbus/modbus_session.hpp"
#include "src/doctor/finding.hpp"

namespace hogline::doctor {

/// The doctor only listens and asks: it sends SDO uploads and Modbus reads. Nothing else may be sent by a site. It asks
/// only for the lines that the rig declares.
class Site {
 public:
  virtual ~Site() = default;
  virtual Stamp now() const = 0;
  /// Lets time pass, with the adapters served.
  virtual void pass(Duration span) = 0;

  virtual hw::CanBus& can() = 0;
  /// Whether the pan-tilt head's nodes are on this bus, if the rig has a head.
  virtual bool has_head() const = 0;
  /// "CAN can0".
  virtual std::string can_line() const = 0;
  /// Adds what the bus' adapter knows: state, counters, what is wrong.
  virtual void describe_can(Finding& finding) const = 0;

  virtual hw::ModbusSession& modbus() = 0;
  /// "Modbus tcp 192.168.1.11:502".
  virtual std::string modbus_line() const = 0;

  /// Adds why nobody can answer on this line, where the machine knows it: no such port, no right to it.
  virtual void describe_modbus_silence(Finding&) const {}

  virtual hw::Gyro& gyro() = 0;
  virtual std::string gyro_line() const = 0;
  /// As for the Modbus line.
  virtual void describe_gyro_silence(Finding&) const {}

  /// Null where the pictures are simulated and this is not the simulated rink.
  virtual hw::Camera* camera(const std::string& name) = 0;
  virtual std::string camera_line(const std::string& name) const = 0;
  /// What to do about a camera that gives no pictures; empty where the kind of error says enough.
  virtual std::string camera_advice(const std::string&) const { return {}; }
  /// Adds what the camera's adapter knows: identity, counters.
  virtual void describe_camera(const std::string& name, Finding& finding) const = 0;
};

}  // namespace hogline::doctor
