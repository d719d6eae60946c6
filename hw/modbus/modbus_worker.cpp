#include "hw/modbus/modbus_worker.hpp"

#include <utility>

namespace hogline::hw {

ModbusWorker::ModbusWorker(const ModbusWorkerConfig& config, const Clock& clock)
    : clock_(clock),
      tick_(config.tick),
      session_(config.session),
      gripper_(session_, config.gripper),
      arm_(session_, config.arm),
      gripper_port_(*this),
      arm_port_(*this),
      thread_([this] { run(); }) {}

ModbusWorker::~ModbusWorker() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

template <typename Change>
void ModbusWorker::post(Change&& change) {
  {
    const std::lock_guard lock(mutex_);
    change(mailbox_);
  }
  wake_.notify_one();
}

void ModbusWorker::rearm() {
  // What was ordered before is not meant for after.
  post([](Mailbox& box) {
    box = Mailbox{};
    box.rearm = true;
  });
}

void ModbusWorker::run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto orders = std::exchange(mailbox_, {});
    lock.unlock();
    apply(orders);
    const Stamp now = clock_.now();
    gripper_.step(now);
    arm_.step(now);
    auto gripper_state = gripper_.state();
    auto arm_state = arm_.state();
    lock.lock();
    gripper_state_ = std::move(gripper_state);
    arm_state_ = std::move(arm_state);
    wake_.wait_for(lock, tick_, [this] { return stopping_ || !mailbox_.empty(); });
  }
}

void ModbusWorker::apply(const Mailbox& orders) {
  if (orders.rearm) {
    gripper_.rearm();
    arm_.rearm();
  }
  if (orders.jaws == JawsOrder::grip) gripper_.grip();
  if (orders.jaws == JawsOrder::release) gripper_.release();
  if (orders.arm == ArmOrder::fold) arm_.fold();
  if (orders.arm == ArmOrder::unfold) arm_.unfold();
  if (orders.spin_radps) gripper_.spin(*orders.spin_radps);
}

GripperState ModbusWorker::GripperPort::state() const {
  const std::lock_guard lock(worker_.mutex_);
  return worker_.gripper_state_;
}
void ModbusWorker::GripperPort::grip() {
  worker_.post([](Mailbox& box) { box.jaws = JawsOrder::grip; });
}
void ModbusWorker::GripperPort::release() {
  worker_.post([](Mailbox& box) { box.jaws = JawsOrder::release; });
}
void ModbusWorker::GripperPort::spin(double radps) {
  worker_.post([radps](Mailbox& box) { box.spin_radps = radps; });
}

ArmState ModbusWorker::ArmPort::state() const {
  const std::lock_guard lock(worker_.mutex_);
  return worker_.arm_state_;
}
void ModbusWorker::ArmPort::fold() {
  worker_.post([](Mailbox& box) { box.arm = ArmOrder::fold; });
}
void ModbusWorker::ArmPort::unfold() {
  worker_.post([](Mailbox& box) { box.arm = ArmOrder::unfold; });
}

}  // namespace hogline::hw
