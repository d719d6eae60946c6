#include "hw/socketcan/can_filter.hpp"

#include <gtest/gtest.h>

using namespace hogline::hw;

namespace {

TEST(CanFilter, ComparesIdentifierLengthAndKind) {
  const CanFilter answers{0x580, 0x780};
  EXPECT_TRUE(answers.matches({.id = 0x585}));
  EXPECT_TRUE(answers.matches({.id = 0x5FF}));
  EXPECT_FALSE(answers.matches({.id = 0x605}));
  EXPECT_FALSE(answers.matches({.id = 0x585, .extended = true})) << "29 bits";
  EXPECT_FALSE(answers.matches({.id = 0x585, .remote = true})) << "no data to act on";
  EXPECT_TRUE((CanFilter{0x18FF0001, 0x1FFFFFFF, true}.matches({.id = 0x18FF0001, .extended = true})));
}

TEST(CanFilter, BitsOutsideTheMaskDoNotCount) { EXPECT_TRUE((CanFilter{0x5FF, 0x780}.matches({.id = 0x581}))); }

TEST(CanFilter, NoFilterMatchesNothing) { EXPECT_FALSE(matches_any({}, {.id = 0})); }

}  // namespace
