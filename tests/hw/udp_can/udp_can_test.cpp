// The CAN bus between programs: its datagrams, two of our own ends, and python-can's own bus as a foreign one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "hw/udp_can/can_datagram.hpp"
#include "hw/udp_can/udp_can_bus.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

Stamp now() { return std::chrono::steady_clock::now(); }

bool eventually(const std::function<bool()>& holds) {
  for (const Stamp end = now() + 30s; now() < end; std::this_thread::sleep_for(2ms))
    if (holds()) return true;
  return holds();
}

// A group of this run's own.
UdpCanConfig own_bus() {
  const auto number = static_cast<unsigned>(getpid());
  return {.group = "239.74." + std::to_string(1 + number % 250) + "." + std::to_string(1 + number / 250 % 250),
          .port = static_cast<std::uint16_t>(20000 + number % 20000),
          .interface = "lo"};
}

const CanFrame frame_181{.id = 0x181, .length = 8, .data = {1, 2, 3, 4, 5, 6, 7, 0xFF}};

std::vector<std::uint8_t> bytes_of(const json& map) { return json::to_msgpack(map); }

json python_map() {
  const auto bytes = pack_can_frame(frame_181, 1.5);
  return json::from_msgpack(bytes);
}

TEST(CanDatagram, is_what_python_can_packs) {
  // msgpack of can.Message(arbitration_id=0x181, data=[1, 2], is_extended_id=False), by python-can 4.1
  static constexpr char packed[] =
      "\x8b\xa9timestamp\xcb\x00\x00\x00\x00\x00\x00\x00\x00\xae"
      "arbitration_id\xcd\x01\x81\xaeis_extended_id\xc2\xafis_remote_frame\xc2\xaeis_error_frame\xc2\xa7"
      "channel\xc0\xa3"
      "dlc\x02\xa4"
      "data\xc4\x02\x01\x02\xa5is_fd\xc2\xae"
      "bitrate_switch\xc2\xb5"
      "error_state_indicator\xc2";
  const std::vector<std::uint8_t> bytes(packed, packed + sizeof(packed) - 1);
  const auto frame = unpack_can_frame(bytes);
  ASSERT_TRUE(frame);
  EXPECT_EQ(*frame, (CanFrame{.id = 0x181, .length = 2, .data = {1, 2}}));
  EXPECT_EQ(json::from_msgpack(pack_can_frame(*frame, 0.0)), json::from_msgpack(bytes));
}

TEST(CanDatagram, carries_every_kind_of_classic_frame) {
  for (const CanFrame& frame : {frame_181, CanFrame{.id = 0x1ABCDEF0, .extended = true, .length = 0},
                                CanFrame{.id = 0x7FF, .remote = true, .length = 4}}) {
    const auto back = unpack_can_frame(pack_can_frame(frame, 12.0));
    ASSERT_TRUE(back) << frame.id;
    EXPECT_EQ(*back, frame);
  }
}

TEST(CanDatagram, refuses_what_is_no_classic_frame) {
  struct Case {
    const char* what;
    std::function<void(json&)> change;
  };
  for (const Case& c : {Case{"an error frame", [](json& m) { m["is_error_frame"] = true; }},
                        {"CAN FD", [](json& m) { m["is_fd"] = true; }},
                        {"too long", [](json& m) { m["dlc"] = 9; }},
                        {"another length than its data", [](json& m) { m["dlc"] = 7; }},
                        {"an identifier of 12 bits", [](json& m) { m["arbitration_id"] = 0x800; }},
                        {"a negative identifier", [](json& m) { m["arbitration_id"] = -1; }},
                        {"an identifier that is a text", [](json& m) { m["arbitration_id"] = "181"; }},
                        {"a flag that is a number", [](json& m) { m["is_extended_id"] = 1; }},
                        {"data as a list",
                         [](json& m) {
                           m["data"] = json::array({1, 2});
                         }},
                        {"no data", [](json& m) { m.erase("data"); }},
                        {"no length", [](json& m) { m.erase("dlc"); }}}) {
    json map = python_map();
    ASSERT_TRUE(unpack_can_frame(bytes_of(map)));
    c.change(map);
    EXPECT_FALSE(unpack_can_frame(bytes_of(map))) << c.what;
  }
  for (const std::string& text :
       {std::string(), std::string("\xc1"), std::string("\x93\x01"), std::string(900, '\xff')}) {
    EXPECT_FALSE(unpack_can_frame({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
  }
  std::vector<std::uint8_t> cut = pack_can_frame(frame_181, 1.0);
  while (!cut.empty()) {
    cut.pop_back();
    EXPECT_FALSE(unpack_can_frame(cut)) << cut.size();
  }
}

TEST(UdpCanConfigTest, names_what_is_wrong) {
  EXPECT_FALSE(config_error({}));
  EXPECT_TRUE(config_error({.group = "192.168.1.1"}));
  EXPECT_TRUE(config_error({.group = "239.74"}));
  EXPECT_TRUE(config_error({.port = 80}));
}

TEST(UdpCanBus, every_other_end_hears_a_frame_once_and_the_sender_does_not) {
  const UdpCanConfig config = own_bus();
  UdpCanBus a(config, now());
  UdpCanBus b(config, now());
  UdpCanBus c(config, now());
  ASSERT_TRUE(a.up() && b.up() && c.up());
  const Stamp before = now();
  for (int i = 0; i < 50; ++i) {
    CanFrame frame = frame_181;
    frame.data[0] = static_cast<std::uint8_t>(i);
    ASSERT_EQ(a.send(frame), CanSendResult::sent);
  }
  for (UdpCanBus* bus : {&b, &c}) {
    for (int i = 0; i < 50; ++i) {
      std::optional<StampedCanFrame> heard;
      ASSERT_TRUE(eventually([&] { return (heard = bus->receive()).has_value(); })) << i;
      EXPECT_EQ(heard->frame.data[0], i) << "in the order of sending";
      EXPECT_GE(heard->stamp, before - 1ms);
      EXPECT_LE(heard->stamp, now());
    }
    EXPECT_FALSE(bus->receive());
  }
  EXPECT_FALSE(a.receive());
}

TEST(UdpCanBus, without_its_interface_it_is_down_and_says_so) {
  UdpCanConfig config = own_bus();
  config.interface = "nowhere0";
  UdpCanBus bus(config, now());
  EXPECT_FALSE(bus.up());
  EXPECT_EQ(bus.send(frame_181), CanSendResult::bus_down);
  EXPECT_FALSE(bus.receive());
  ASSERT_TRUE(bus.error());
  EXPECT_NE(bus.error()->what.find("nowhere0"), std::string::npos);
}

// Python's end reads and writes; closing its stdin ends it.
TEST(UdpCanBus, python_can_hears_us_and_is_heard) {
  const UdpCanConfig config = own_bus();
  UdpCanBus bus(config, now());
  ASSERT_TRUE(bus.up());
  const std::string said = testing::TempDir() + "udp_can_echo." + std::to_string(getpid());
  FILE* python = popen(("/usr/bin/python3 " HOGLINE_SOURCE_DIR "/tests/peers/udp_can_echo.py " + config.group + " " +
                        std::to_string(config.port) + " > " + said)
                           .c_str(),
                       "w");
  ASSERT_NE(python, nullptr);
  const CanFrame extended{.id = 0x12345, .extended = true, .length = 3, .data = {7, 8, 9}};
  for (const CanFrame& frame : {frame_181, extended}) {
    CanFrame echo = frame;
    echo.id += 1;
    EXPECT_TRUE(eventually([&] {
      bus.send(frame);
      std::this_thread::sleep_for(20ms);
      while (const auto heard = bus.receive())
        if (heard->frame == echo) return true;
      return false;
    })) << frame.id;
  }
  pclose(python);
  std::remove(said.c_str());
  EXPECT_EQ(bus.counters().malformed, 0U);
}

}  // namespace
}  // namespace hogline::hw
