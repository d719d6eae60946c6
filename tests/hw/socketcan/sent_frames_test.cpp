#include "hw/socketcan/sent_frames.hpp"

#include <gtest/gtest.h>

using namespace hogline;
using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

TEST(SentFrames, AreConfirmedInAnyOrder) {
  SentFrames sent;
  sent.add({.id = 0x301}, Stamp{} + 1ms);
  sent.add({.id = 0x201}, Stamp{} + 2ms);
  EXPECT_TRUE(sent.confirm({.id = 0x201})) << "the higher priority went first";
  EXPECT_EQ(sent.oldest(), Stamp{} + 1ms);
  EXPECT_TRUE(sent.confirm({.id = 0x301}));
  EXPECT_FALSE(sent.oldest());
}

TEST(SentFrames, KnowWhichIdentifiersAreOnTheirWayWhateverTheirContents) {
  SentFrames sent;
  sent.add({.id = 0x201, .length = 1, .data = {1}}, Stamp{} + 1ms);
  EXPECT_TRUE(sent.holds({.id = 0x201, .length = 1, .data = {2}}));
  EXPECT_FALSE(sent.holds({.id = 0x202}));
  EXPECT_FALSE(sent.holds({.id = 0x201, .extended = true}));
  EXPECT_TRUE(sent.confirm({.id = 0x201, .length = 1, .data = {1}}));
  EXPECT_FALSE(sent.holds({.id = 0x201}));
}

TEST(SentFrames, EqualFramesAreConfirmedOnceEach) {
  SentFrames sent;
  sent.add({.id = 0x80}, Stamp{} + 1ms);
  sent.add({.id = 0x80}, Stamp{} + 6ms);
  EXPECT_TRUE(sent.confirm({.id = 0x80}));
  EXPECT_EQ(sent.oldest(), Stamp{} + 6ms);
  EXPECT_TRUE(sent.confirm({.id = 0x80}));
  EXPECT_FALSE(sent.confirm({.id = 0x80})) << "a duplicate on the bus";
}

TEST(SentFrames, ExpireByTheirAge) {
  SentFrames sent;
  for (int i = 0; i < 10; ++i) sent.add({.id = 0x80}, Stamp{} + i * 1ms);
  EXPECT_EQ(sent.expire(Stamp{} + 4ms), 4U);
  EXPECT_EQ(sent.size(), 6U);
  EXPECT_EQ(sent.expire(Stamp{} + 1s), 6U);
}

TEST(SentFrames, AFullListForgetsTheOldest) {
  SentFrames sent;
  for (std::uint32_t i = 0; i < SentFrames::capacity; ++i) EXPECT_TRUE(sent.add({.id = i}, Stamp{}));
  EXPECT_FALSE(sent.add({.id = 0x7FF}, Stamp{}));
  EXPECT_EQ(sent.size(), SentFrames::capacity);
  EXPECT_FALSE(sent.confirm({.id = 0}));
  EXPECT_TRUE(sent.confirm({.id = 0x7FF}));
}

}  // namespace
