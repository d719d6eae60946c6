// What the tests on the kernel's interfaces share.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "hw/socketcan/socket_can_bus.hpp"

namespace hogline::hil {

using namespace std::chrono_literals;

/// Long enough for a busy machine: a test that passes never waits for it.
inline constexpr Duration generous = std::chrono::seconds(20);

Stamp now();

/// Calls `done` every `rhythm` until it holds; false after `limit`.
bool wait_until(const std::function<bool()>& done, Duration limit = generous,
                std::chrono::milliseconds rhythm = std::chrono::milliseconds(1));

/// A control period: step, then read everything.
std::vector<hw::StampedCanFrame> period(hw::SocketCanBus& bus);

/// Runs periods until `done` holds; false after `limit`. What was received is dropped.
bool run_until(hw::SocketCanBus& bus, const std::function<bool()>& done, Duration limit = generous);

/// Runs periods until this many frames were received, or `limit`.
std::vector<hw::StampedCanFrame> receive(hw::SocketCanBus& bus, std::size_t count, Duration limit = generous);

/// An up vcan interface of the test's own, deleted at its end.
class VcanTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// An adapter on it that is up. A busy machine may bring a confirmation late: tests of lost frames set a deadline.
  hw::SocketCanBus running_bus(hw::SocketCanConfig config = {.confirm_deadline = generous}) const;

  const std::string name_ = "vtest";
};

}  // namespace hogline::hil
