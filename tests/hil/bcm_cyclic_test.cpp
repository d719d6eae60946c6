// SYNC by the kernel's timer: it comes without us, ends with us, and survives what happens to the interface.
#include "hw/socketcan/bcm_cyclic.hpp"

#include <cstring>

#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

constexpr CanFrame sync{.id = 0x080};

class BcmSync : public VcanTest {
 protected:
  // Whether this many more SYNCs come.
  static bool come(CanNode& node, std::size_t count) {
    node.hear_all();
    return node.hear(count).size() >= count;
  }
  // Whether none comes for fifty periods.
  static bool silent(CanNode& node) {
    node.hear_all();
    for (const Stamp end = now() + 250ms; now() < end;) wait_until([] { return false; }, 10ms);
    return node.hear_all().empty();
  }
};

TEST_F(BcmSync, ComesWithoutTheProgramDoingAnything) {
  CanNode node(name_);
  const Stamp start = now();
  BcmCyclic cyclic(name_, sync, 5ms, start);
  ASSERT_TRUE(cyclic.running()) << std::strerror(cyclic.error());
  const auto heard = node.hear(100);
  ASSERT_GE(heard.size(), 100U);
  for (const can_frame& frame : heard) {
    ASSERT_EQ(frame.can_id, 0x080U);
    ASSERT_EQ(frame.can_dlc, 0);
  }
  EXPECT_GE(now() - start, 99 * 5ms) << "no faster than asked";
}

TEST_F(BcmSync, PausesAndResumes) {
  CanNode node(name_);
  BcmCyclic cyclic(name_, sync, 5ms, now());
  ASSERT_TRUE(come(node, 3));
  cyclic.pause();
  EXPECT_FALSE(cyclic.running());
  EXPECT_TRUE(silent(node));
  cyclic.resume();
  EXPECT_TRUE(come(node, 3));
}

TEST_F(BcmSync, EndsWithItsObject) {
  CanNode node(name_);
  {
    BcmCyclic cyclic(name_, sync, 5ms, now());
    ASSERT_TRUE(come(node, 3));
  }
  EXPECT_TRUE(silent(node));
}

TEST_F(BcmSync, GoesOnWhenTheLinkComesBack) {
  BcmCyclic cyclic(name_, sync, 5ms, now());
  CanNode node(name_);
  ASSERT_TRUE(come(node, 3));
  run("ip link set " + name_ + " down");
  run("ip link set " + name_ + " up");
  cyclic.step(now());
  EXPECT_TRUE(cyclic.running());
  EXPECT_TRUE(come(node, 3));
}

TEST_F(BcmSync, StartsAgainOnAnAdapterThatWasCreatedAgain) {
  BcmCyclic cyclic(name_, sync, 5ms, now());
  run("ip link del " + name_);
  cyclic.step(now());
  EXPECT_FALSE(cyclic.running());
  EXPECT_EQ(cyclic.error(), ENODEV);
  run("ip link add " + name_ + " type vcan && ip link set " + name_ + " up");
  CanNode node(name_);
  ASSERT_TRUE(wait_until([&] {
    cyclic.step(now());
    return cyclic.running();
  }));
  EXPECT_TRUE(come(node, 3));
}

TEST_F(BcmSync, StartsWhenTheInterfaceComesLaterThanTheProgram) {
  run("ip link del " + name_);
  BcmCyclic cyclic(name_, sync, 5ms, now());
  EXPECT_FALSE(cyclic.running());
  run("ip link add " + name_ + " type vcan && ip link set " + name_ + " up");
  CanNode node(name_);
  ASSERT_TRUE(wait_until([&] {
    cyclic.step(now());
    return cyclic.running();
  }));
  EXPECT_TRUE(come(node, 3));
}

TEST_F(BcmSync, IsNoSecondMasterForTheAdapterBesideIt) {
  SocketCanBus bus = running_bus({.receive = {{0x185}}, .own = {{0x205}}});
  BcmCyclic cyclic(name_, sync, 5ms, now());
  CanNode node(name_);
  ASSERT_TRUE(come(node, 20));
  period(bus);
  EXPECT_EQ(bus.state().counters.foreign, 0U);
  EXPECT_EQ(bus.state().counters.received, 0U) << "SYNC is not among its filters";
}

}  // namespace
