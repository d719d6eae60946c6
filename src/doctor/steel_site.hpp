// The robot itself: kernel CAN, Modbus line, cameras, as its rig file names them.
#pragma once

#include <map>
#include <memory>

#include "hw/aravis/aravis_camera.hpp"
#include "hw/clock.hpp"
#include "hw/dsp3000/serial_port.hpp"
#include "hw/socketcan/socket_can_bus.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

class SteelSite final : public Site {
 public:
  /// Opens the CAN interface. Cameras are opened when they are asked for. The rig must outlive the site.
  explicit SteelSite(const config::ThrowerRig& rig);

  Stamp now() const override { return clock_.now(); }
  void pass(Duration span) override;
  hw::CanBus& can() override { return can_; }
  bool has_head() const override { return true; }
  std::string can_line() const override;
  void describe_can(Finding& finding) const override;
  hw::ModbusSession& modbus() override { return modbus_; }
  std::string modbus_line() const override;
  hw::Gyro& gyro() override { return gyro_; }
  std::string gyro_line() const override;
  hw::Camera* camera(const std::string& name) override;
  std::string camera_line(const std::string& name) const override;
  void describe_camera(const std::string& name, Finding& finding) const override;

 private:
  const config::ThrowerRig& rig_;
  hw::SteadyClock clock_;
  hw::SocketCanBus can_;
  hw::ModbusSession modbus_;
  hw::SerialPort gyro_port_;
  hw::Dsp3000Gyro gyro_;
  std::map<std::string, std::unique_ptr<hw::Camera>> cameras_;
};

}  // namespace hogline::doctor
