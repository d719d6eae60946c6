#include "tests/hil/python_node.hpp"

#include "hw/socketcan/candump_log.hpp"

namespace hogline::hil {

using namespace hogline::hw;

CanFrame frame(const std::string& text) {
  const CandumpLine line = decode_candump_line("(0.000000) x " + text);
  EXPECT_TRUE(line.record) << text << ": " << line.reason;
  return line.record ? line.record->frame : CanFrame{};
}

std::string text(const CanFrame& frame) {
  const std::string line = encode_candump_line({{}, "x", frame});
  return line.substr(line.rfind(' ') + 1);
}

SdoResult transfer(SocketCanBus& bus, SdoClient& client, std::uint8_t node) {
  std::optional<SdoResult> result;
  wait_until([&] {
    for (const auto& received : period(bus))
      if (received.frame.id == 0x580U + node) client.on_frame(received.frame, now());
    client.step(now());
    while (const auto request = client.take_frame()) EXPECT_EQ(bus.send(*request), CanSendResult::sent);
    result = client.take_result();
    return result.has_value();
  });
  EXPECT_TRUE(result) << "no end of the transfer";
  return result.value_or(SdoResult{});
}

void PythonNode::SetUpTestSuite() {
  nodes_ =
      std::make_unique<Process>(std::vector<std::string>{HOGLINE_SOURCE_DIR "/tests/peers/canopen_node.py", "--channel",
                                                         "vcan0", "--node", "1", "--node", "2", "--node", "5"});
  SocketCanBus bus = running_bus();
  started_ = heard(bus, "705#00");
}

void PythonNode::SetUp() {
  ASSERT_TRUE(started_) << "canopen_node.py never sent its boot-up messages";
  SocketCanBus bus = running_bus();
  ASSERT_TRUE(wait_until([&] {  // a peer that was overrun may miss one
    EXPECT_EQ(bus.send(frame("000#8100")), CanSendResult::sent);
    return heard(bus, "705#00", 5s);
  }));
}

SocketCanBus PythonNode::running_bus(SocketCanConfig config) {
  config.interface = "vcan0";
  SocketCanBus bus(std::move(config), now());
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
  return bus;
}

std::string PythonNode::answer(SocketCanBus& bus) {
  for (const Stamp end = now() + generous; now() < end;) {
    const auto received = receive(bus, 1);
    if (!received.empty() && (received[0].frame.id & 0x780) != 0x700) return text(received[0].frame);
  }
  return "nothing";
}

bool PythonNode::heard(SocketCanBus& bus, const std::string& expected, Duration limit) {
  const auto came = [&] {
    for (const auto& received : period(bus))
      if (text(received.frame) == expected) return true;
    return false;
  };
  return wait_until(came, limit);
}

std::uint32_t Observer::read(std::uint8_t node, ObjectAddress address) {
  SdoClient client(node, generous);
  client.start_upload(address, now());
  return transfer(bus_, client, node).value().value_or(0xFFFFFFFF);
}

}  // namespace hogline::hil
