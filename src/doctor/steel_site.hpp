// The robot itself: kernel CAN, Modbus line, cameras, as its rig file names them.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "hw/aravis/aravis_camera.hpp"
#include "hw/clock.hpp"
#include "hw/dsp3000/serial_port.hpp"
#include "hw/socketcan/socket_can_bus.hpp"
#include "src/config/device_rig.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

class SteelSite final : public Site {
 public:
  /// Opens the lines that the rig declares; cameras are opened when they are asked for. The rig must outlive the site.
  explicit SteelSite(const config::DeviceRig& rig);

  Stamp now() const override { return clock_.now(); }
  void pass(Duration span) override;
  hw::CanBus& can() override { return can_.value(); }
  bool has_head() const override { return true; }
  std::string can_line() const override;
  void describe_can(Finding& finding) const override;
  hw::ModbusSession& modbus() override { return modbus_.value(); }
  std::string modbus_line() const override;
  void describe_modbus_silence(Finding& finding) const override;
  hw::Gyro& gyro() override { return gyro_.value(); }
  std::string gyro_line() const override;
  void describe_gyro_silence(Finding& finding) const override;
  hw::Camera* camera(const std::string& name) override;
  std::string camera_line(const std::string& name) const override;
  std::string camera_advice(const std::string& name) const override;
  void describe_camera(const std::string& name, Finding& finding) const override;

 private:
  const config::DeviceRig& rig_;
  hw::SteadyClock clock_;
  std::optional<hw::SocketCanBus> can_;
  std::optional<hw::ModbusSession> modbus_;
  std::optional<hw::SerialPort> gyro_port_;
  std::optional<hw::Dsp3000Gyro> gyro_;
  std::map<std::string, std::unique_ptr<hw::Camera>> cameras_;
};

}  // namespace hogline::doctor
