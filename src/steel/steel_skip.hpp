// A skip of steel: its head on the bus, and the two cameras on it, behind the same ports as the simulated skip's.
#pragma once

#include <memory>

#include "hw/canopen/two_axis_head.hpp"
#include "hw/checks/checked_camera.hpp"
#include "hw/clock.hpp"
#include "src/config/skip_rig.hpp"
#include "src/steel/robot_bus.hpp"

namespace hogline {

/// A step reads the bus, then the head talks.
class BusHead final : public hw::Head {
 public:
  BusHead(RobotBus& bus, hw::TwoAxisHead& head) : bus_(bus), head_(head) {}
  void step(Stamp now) override {
    bus_.step(now);
    head_.step(now);
  }
  hw::HeadState state() const override { return head_.state(); }
  void enable() override { head_.enable(); }
  void point(const hw::PanTilt& target, Stamp now) override { head_.point(target, now); }
  void track(const hw::PanTiltRate& rates, Stamp now) override { head_.track(rates, now); }
  void stop() override { head_.stop(); }
  void rearm() override { head_.rearm(); }

 private:
  RobotBus& bus_;
  hw::TwoAxisHead& head_;
};

/// Opens everything, switches nothing on. What can not be opened is a device error at its port. Ports are used by one
/// thread.
class SteelSkip {
 public:
  /// Throws ConfigError where the rig names no CAN bus, or a camera's pictures are simulated. The clock must outlive
  /// it.
  SteelSkip(const config::SkipRig& rig, const hw::Clock& clock);
  SteelSkip(const SteelSkip&) = delete;
  SteelSkip& operator=(const SteelSkip&) = delete;

  hw::Head& head() { return head_; }
  hw::Camera& near_camera() { return near_checked_; }
  hw::Camera& far_camera() { return far_checked_; }

 private:
  RobotBus bus_;
  hw::TwoAxisHead axes_;
  BusHead head_;
  std::unique_ptr<hw::Camera> near_camera_;
  std::unique_ptr<hw::Camera> far_camera_;
  hw::CheckedCamera near_checked_;
  hw::CheckedCamera far_checked_;
};

}  // namespace hogline
