#include "src/steel/steel_robot.hpp"

#include "src/steel/rig_camera.hpp"

namespace hogline {
namespace {

std::vector<std::uint8_t> nodes_of(const config::ThrowerRig& rig) {
  std::vector<std::uint8_t> nodes{rig.drive.left.node, rig.drive.right.node};
  if (rig.head) nodes.insert(nodes.end(), {rig.head->pan.identity.node, rig.head->tilt.identity.node});
  return nodes;
}

// An order that has waited for the line as long as a gripper's state may be old comes too late.
hw::ModbusWorkerConfig worker_config(const config::ThrowerRig& rig) {
  return {.session = rig.modbus,
          .gripper = rig.gripper,
          .arm = rig.arm,
          .tick = rig.drive.timing.control_period,
          .order_age_limit = rig.thrower.ages.gripper};
}

}  // namespace

SteelRobot::SteelRobot(const config::ThrowerRig& rig, const hw::Clock& clock)
    : clock_(clock),
      bus_(rig.rig, nodes_of(rig), rig.drive.master_node, rig.drive.duties, clock.now()),
      hub_(bus_.bus()),
      wheels_(hub_.make_endpoint(), rig.drive),
      drive_(bus_, wheels_, rig.head ? &head_.emplace(hub_.make_endpoint(), *rig.head) : nullptr),
      modbus_(worker_config(rig), clock),
      gyro_port_(rig.gyro_port),
      gyro_(gyro_port_, rig.gyro),
      near_camera_(open_real_camera(rig.rig, "near", clock)),
      low_camera_(open_real_camera(rig.rig, "low", clock)),
      near_checked_(*near_camera_, watch_of(rig.rig, "near")),
      low_checked_(*low_camera_, watch_of(rig.rig, "low")) {}

}  // namespace hogline
