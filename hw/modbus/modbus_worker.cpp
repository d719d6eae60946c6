#include "hw/modbus/modbus_worker.hpp"

#include <utility>

namespace hogline::hw {

namespace {

constexpr const char* came_late = "an order waited too long for the line and was dropped";

}  // namespace

ModbusWorker::ModbusWorker(const ModbusWorkerConfig& config, const Clock& clock)
    : clock_(clock),
      tick_(config.tick),
      order_age_limit_(config.order_age_limit),
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
    change(mailbox_, clock_.now());
  }
  wake_.notify_one();
}

void ModbusWorker::run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const Mailbox orders = std::exchange(mailbox_, Mailbox{});
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
  const Stamp now = clock_.now();
  if (orders.rearm_gripper) gripper_.rearm();
  if (orders.rearm_arm) arm_.rearm();
  if (orders.jaws) apply_jaws(*orders.jaws, now);
  if (orders.spin_radps) apply_spin(*orders.spin_radps, now);
  if (orders.arm) apply_arm(*orders.arm, now);
}

void ModbusWorker::apply_jaws(const PostedOrder<JawsOrder>& order, Stamp now) {
  if (too_old(order.since, now)) return gripper_.drop_jaws_order(came_late, now);
  if (order.what == JawsOrder::grip) gripper_.grip();
  if (order.what == JawsOrder::release) gripper_.release();
}

void ModbusWorker::apply_spin(const PostedOrder<double>& order, Stamp now) {
  if (too_old(order.since, now)) return gripper_.drop_spin_order(came_late, now);
  gripper_.spin(order.what);
}

void ModbusWorker::apply_arm(const PostedOrder<ArmOrder>& order, Stamp now) {
  if (too_old(order.since, now)) return arm_.drop_order(came_late, now);
  if (order.what == ArmOrder::fold) arm_.fold();
  if (order.what == ArmOrder::unfold) arm_.unfold();
}

GripperState ModbusWorker::GripperPort::state() const {
  const std::lock_guard lock(worker_.mutex_);
  return worker_.gripper_state_;
}
void ModbusWorker::GripperPort::grip() {
  worker_.post([](Mailbox& box, Stamp now) { box.jaws = {JawsOrder::grip, now}; });
}
void ModbusWorker::GripperPort::release() {
  worker_.post([](Mailbox& box, Stamp now) {
    // Repeating it makes it no younger: the place for it is passing.
    if (box.jaws && box.jaws->what == JawsOrder::release) return;
    box.jaws = {JawsOrder::release, now};
  });
}
void ModbusWorker::GripperPort::spin(double radps) {
  worker_.post([radps](Mailbox& box, Stamp now) { box.spin_radps = {radps, now}; });
}
void ModbusWorker::GripperPort::rearm() {
  // What was ordered before is not meant for after.
  worker_.post([](Mailbox& box, Stamp) {
    box.jaws.reset();
    box.spin_radps.reset();
    box.rearm_gripper = true;
  });
}

ArmState ModbusWorker::ArmPort::state() const {
  const std::lock_guard lock(worker_.mutex_);
  return worker_.arm_state_;
}
void ModbusWorker::ArmPort::fold() {
  worker_.post([](Mailbox& box, Stamp now) { box.arm = {ArmOrder::fold, now}; });
}
void ModbusWorker::ArmPort::unfold() {
  worker_.post([](Mailbox& box, Stamp now) { box.arm = {ArmOrder::unfold, now}; });
}
void ModbusWorker::ArmPort::rearm() {
  worker_.post([](Mailbox& box, Stamp) {
    box.arm.reset();
    box.rearm_arm = true;
  });
}

}  // namespace hogline::hw
