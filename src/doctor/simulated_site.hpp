// The simulated rink as a place to examine: the same devices that a simulated throw uses.
#pragma once

#include "src/doctor/site.hpp"
#include "src/throwing/simulated_robot.hpp"

namespace hogline::doctor {

class SimulatedSite final : public Site {
 public:
  /// The robot must outlive the site; its own adapters are not stepped, except the gyro's, which only listens.
  explicit SimulatedSite(SimulatedRobot& robot) : robot_(robot) {}

  Stamp now() const override { return robot_.rink().now(); }
  void pass(Duration span) override { robot_.rink().step(span); }
  hw::CanBus& can() override { return robot_.rink().can(); }
  bool has_head() const override { return false; }
  std::string can_line() const override { return "CAN simulated"; }
  void describe_can(Finding&) const override {}
  hw::ModbusSession& modbus() override { return robot_.session(); }
  std::string modbus_line() const override { return "Modbus simulated"; }
  hw::Gyro& gyro() override { return robot_.devices().gyro; }
  std::string gyro_line() const override { return "serial simulated"; }
  hw::Camera* camera(const std::string& name) override;
  std::string camera_line(const std::string&) const override { return "simulated"; }
  void describe_camera(const std::string&, Finding&) const override {}

 private:
  SimulatedRobot& robot_;
};

}  // namespace hogline::doctor
