#include "hw/canopen/bus_identifiers.hpp"

#include <gmock/gmock.h>

#include <array>

namespace hogline::hw::test {
namespace {

using testing::Contains;
using testing::Not;
using testing::UnorderedElementsAre;

constexpr std::array<std::uint8_t, 1> one_node{5};

TEST(BusIdentifiers, AreThoseOfThePredefinedConnectionSet) {
  const BusIdentifiers ids = bus_identifiers(one_node, 127);
  EXPECT_THAT(ids.heard, UnorderedElementsAre(0x085u, 0x185u, 0x285u, 0x585u, 0x705u));
  EXPECT_THAT(ids.own, UnorderedElementsAre(0x000u, 0x080u, 0x205u, 0x305u, 0x605u, 0x77Fu));
  EXPECT_THAT(ids.set_points, UnorderedElementsAre(0x080u, 0x205u, 0x305u));
}

TEST(BusIdentifiers, WhatSomebodyElseSendsIsNotOurs) {
  const BusIdentifiers ids = bus_identifiers(one_node, 127, {.sync = false, .heartbeat = false});
  EXPECT_THAT(ids.own, Not(Contains(0x080u)));
  EXPECT_THAT(ids.own, Not(Contains(0x77Fu)));
  EXPECT_THAT(ids.set_points, Not(Contains(0x080u)));
}

}  // namespace
}  // namespace hogline::hw::test
