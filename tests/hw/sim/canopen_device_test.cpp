// The communication of the simulated device, by raw frames.
#include "hw/sim/canopen_device.hpp"

#include <gtest/gtest.h>

#include "hw/sim/virtual_can_bus.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;

class CanopenDeviceTest : public testing::Test, protected sim::CanopenDevice::Application {
 protected:
  CanopenDeviceTest() {
    device.objects().add(0x2000, 0, 2, sim::ObjectAccess::read_write, 0, true);
    device.objects().add(0x6040, 0, 2, sim::ObjectAccess::read_write, 0, true);
    device.objects().add(0x6041, 0, 2, sim::ObjectAccess::read_only, 0x0240, true);
    device.objects().add(0x2001, 0, 4, sim::ObjectAccess::read_only, 0, false);
  }

  void on_reset() override { ++resets; }
  void on_communication_lost() override { ++losses; }

  /// Sends, lets `span` pass in milliseconds, and returns what the device said.
  std::vector<std::string> say(const std::vector<std::string>& frames, Duration span = 1ms) {
    for (const std::string& one : frames) master.send(frame(one));
    std::vector<std::string> heard;
    for (Duration t{0}; t < span; t += 1ms) {
      clock.advance(1ms);
      bus.deliver();
      device.step(clock.now());
      bus.deliver();
      while (const auto received = master.receive()) heard.push_back(text(received->frame));
    }
    return heard;
  }

  using Frames = std::vector<std::string>;

  SteppedClock clock{Stamp{10s}};
  sim::VirtualCanBus bus{clock};
  CanBus& master = bus.make_endpoint();
  sim::CanopenDevice device{
      bus.make_endpoint(), {.node = 5, .device_type = 0x00020192, .name = "X", .boot_time = 20ms}, *this};
  int resets = 0;
  int losses = 0;
};

TEST_F(CanopenDeviceTest, BootsOnceAndStaysPreOperational) {
  EXPECT_EQ(say({}, 100ms), Frames{"705#00"});
  EXPECT_EQ(device.nmt(), sim::CanopenDevice::Nmt::pre_operational);
}

TEST_F(CanopenDeviceTest, IsDeafWhileItBoots) { EXPECT_EQ(say({"605#4000100000000000"}, 10ms), Frames{}); }

TEST_F(CanopenDeviceTest, HeartbeatTellsTheState) {
  say({}, 30ms);
  EXPECT_EQ(say({"605#2B17100032000000"}, 1ms), (Frames{"585#6017100000000000", "705#7F"}));
  EXPECT_EQ(say({"000#0105"}, 50ms), (Frames{"185#4002", "705#05"})) << "TPDO1 is event-driven by default";
  EXPECT_EQ(say({"000#0200"}, 50ms), Frames{"705#04"});
  EXPECT_EQ(losses, 1);
  EXPECT_EQ(say({"000#0106"}, 50ms), Frames{"705#04"}) << "for another node";
}

TEST_F(CanopenDeviceTest, ResetCommunicationRestoresItsObjects) {
  say({}, 30ms);
  say({"605#2B17100032000000", "605#2B00200034120000"}, 5ms);
  EXPECT_EQ(say({"000#8205"}, 50ms), Frames{"705#00"});
  EXPECT_EQ(device.objects().get(0x1017), 0u);
  EXPECT_EQ(device.objects().get(0x2000), 0x1234u) << "not a communication object";
  EXPECT_EQ(resets, 0);
  say({"000#8105"}, 50ms);
  EXPECT_EQ(device.objects().get(0x2000), 0u);
  EXPECT_EQ(resets, 1);
}

TEST_F(CanopenDeviceTest, StoppedAnswersNoSdo) {
  say({}, 30ms);
  say({"000#0205"});
  EXPECT_EQ(say({"605#4000100000000000"}), Frames{});
}

TEST_F(CanopenDeviceTest, AMappingNeedsThePdoOffAndItsCountZero) {
  say({}, 30ms);
  EXPECT_EQ(say({"605#2F00160000000000"}), Frames{"585#8000160000000106"}) << "still valid";
  EXPECT_EQ(say({"605#2300140105020080"}), Frames{"585#6000140100000000"});
  EXPECT_EQ(say({"605#2300160110000020"}), Frames{"585#8000160100000106"}) << "count is not 0";
  EXPECT_EQ(say({"605#2F00160000000000"}), Frames{"585#6000160000000000"});
  EXPECT_EQ(say({"605#2300160110005555"}), Frames{"585#8000160100000206"}) << "no such object";
  EXPECT_EQ(say({"605#2300160120000120"}), Frames{"585#8000160141000406"}) << "not mappable";
  EXPECT_EQ(say({"605#2300160110004160"}), Frames{"585#8000160141000406"}) << "read-only in an RPDO";
  EXPECT_EQ(say({"605#2300160110000020"}), Frames{"585#6000160100000000"});
}

TEST_F(CanopenDeviceTest, MoreThanEightBytesAreRefused) {
  say({}, 30ms);
  say({"605#2300140105020080", "605#2F00160000000000"});
  for (const char* entry : {"605#2300160110000020", "605#2300160210000020", "605#2300160310000020",
                            "605#2300160410000020", "605#2300160510000020"}) {
    say({entry});
  }
  EXPECT_EQ(say({"605#2F00160005000000"}), Frames{"585#8000160042000406"});
  EXPECT_EQ(say({"605#2F00160004000000"}), Frames{"585#6000160000000000"});
}

/// RPDO1: 2000; TPDO1: 6041; both with SYNC; RPDO timer 40 ms.
const std::vector<std::string> map_pdos{"605#2300140105020080", "605#2F00160000000000", "605#2300160110000020",
                                        "605#2F00160001000000", "605#2F00140201000000", "605#2B00140528000000",
                                        "605#2300140105020000", "605#2F00180201000000"};

TEST_F(CanopenDeviceTest, SynchronousPdosActOnTheSync) {
  say({}, 30ms);
  say(map_pdos);
  say({"000#0105"});
  say({"205#3412"});
  EXPECT_EQ(device.objects().get(0x2000), 0u) << "waits for SYNC";
  EXPECT_EQ(say({"080#"}), Frames{"185#4002"});
  EXPECT_EQ(device.objects().get(0x2000), 0x1234u);
}

TEST_F(CanopenDeviceTest, PdosAreDeadBeforeOperational) {
  say({}, 30ms);
  say(map_pdos);
  EXPECT_EQ(say({"205#3412", "080#"}), Frames{});
  EXPECT_EQ(device.objects().get(0x2000), 0u);
}

TEST_F(CanopenDeviceTest, TheRpdoTimerStartsWithTheFirstReceptionAndCriesOnce) {
  say({}, 30ms);
  say(map_pdos);
  EXPECT_EQ(say({"000#0105"}, 100ms), Frames{}) << "nothing received yet";
  EXPECT_EQ(say({"205#3412"}, 39ms), Frames{});
  EXPECT_EQ(say({}, 100ms), Frames{"085#5082110000000000"});
  EXPECT_EQ(losses, 1);
}

TEST_F(CanopenDeviceTest, AShortRpdoIsNotUsed) {
  say({}, 30ms);
  say(map_pdos);
  EXPECT_EQ(say({"000#0105", "205#34"}), Frames{"085#1082110000000000"});
  say({"080#"});
  EXPECT_EQ(device.objects().get(0x2000), 0u);
}

TEST_F(CanopenDeviceTest, TheMastersHeartbeatIsWatchedFromItsFirstOneOn) {
  say({}, 30ms);
  say({"605#2316100196007F00"});  // node 127, 150 ms
  EXPECT_EQ(say({"000#0105"}, 500ms), Frames{"185#4002"});
  EXPECT_EQ(say({"77F#05"}, 149ms), Frames{});
  EXPECT_EQ(say({}, 100ms), Frames{"085#3081110000000000"});
  EXPECT_EQ(losses, 1);
  EXPECT_EQ(device.nmt(), sim::CanopenDevice::Nmt::pre_operational);
}

TEST_F(CanopenDeviceTest, ACobIdMayNotChangeWhileThePdoIsValid) {
  say({}, 30ms);
  EXPECT_EQ(say({"605#2300140106020000"}), Frames{"585#8000140130000906"});
}

}  // namespace
}  // namespace hogline::hw::test
