// Foreign nodes on vcan0: tests/peers/canopen_node.py, written from the standards in Python.
#pragma once

#include <memory>
#include <string>

#include "hw/canopen/cia402.hpp"
#include "hw/canopen/sdo_client.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

namespace hogline::hil {

/// From and to the words of a log: "605#40...".
hw::CanFrame frame(const std::string& text);
std::string text(const hw::CanFrame& frame);

/// Carries out the transfer that `client` has begun with this node.
hw::SdoResult transfer(hw::SocketCanBus& bus, hw::SdoClient& client, std::uint8_t node);

/// One program with the nodes 1, 2 (drives of the wheels) and 5 for all tests: it takes seconds to start. Each test
/// resets them.
class PythonNode : public testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite() { nodes_.reset(); }
  void SetUp() override;

  /// An adapter on vcan0 that is up.
  static hw::SocketCanBus running_bus(hw::SocketCanConfig config = {});
  /// The next frame that is no heartbeat.
  static std::string answer(hw::SocketCanBus& bus);
  static bool heard(hw::SocketCanBus& bus, const std::string& expected, Duration limit = generous);

 private:
  static inline std::unique_ptr<Process> nodes_;
  static inline bool started_ = false;
};

/// What the nodes say of themselves, asked by SDO.
class Observer {
 public:
  explicit Observer(hw::SocketCanBus& bus) : bus_(bus) {}
  std::int32_t velocity(std::uint8_t node) { return static_cast<std::int32_t>(read(node, {0x606C, 0})); }
  hw::Cia402State state(std::uint8_t node) {
    return hw::decode_statusword(static_cast<std::uint16_t>(read(node, {0x6041, 0})));
  }

 private:
  std::uint32_t read(std::uint8_t node, hw::ObjectAddress address);
  hw::SocketCanBus& bus_;
};

}  // namespace hogline::hil
