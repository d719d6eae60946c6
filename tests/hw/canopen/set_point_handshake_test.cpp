// The set-point handshake as a table of its standard's figure: bits in, bits out.
#include "hw/canopen/set_point_handshake.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;
using Phase = SetPointHandshake::Phase;

constexpr Stamp t0{100s};
constexpr std::uint16_t none = 0;
constexpr std::uint16_t both = new_set_point_bit | change_immediately_bit;

struct Row {
  const char* what;
  bool acknowledge;  ///< statusword bit 12
  std::uint16_t bits;
  Phase phase;
};

TEST(SetPointHandshake, OneTargetIsOfferedRaisedAcknowledgedAndLowered) {
  SetPointHandshake handshake;
  handshake.request(1234);
  EXPECT_FALSE(handshake.settled());
  const Row rows[] = {
      {"the target is on the bus before the edge", false, none, Phase::offered},
      {"the edge", false, both, Phase::raised},
      {"held until acknowledged", false, both, Phase::raised},
      {"acknowledged", true, none, Phase::lowered},
      {"until the drive is ready for the next", true, none, Phase::lowered},
      {"done", false, none, Phase::idle},
      {"nothing without a request", false, none, Phase::idle},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(handshake.step(row.acknowledge ? set_point_acknowledge_bit : 0, t0), row.bits) << row.what;
    EXPECT_EQ(handshake.phase(), row.phase) << row.what;
    EXPECT_EQ(handshake.target(), 1234) << row.what;
  }
  EXPECT_TRUE(handshake.settled());
}

TEST(SetPointHandshake, AnAcknowledgementFromBeforeIsWaitedOut) {
  SetPointHandshake handshake;
  handshake.request(1);
  EXPECT_EQ(handshake.step(set_point_acknowledge_bit, t0), none);
  EXPECT_EQ(handshake.step(set_point_acknowledge_bit, t0), none) << "an edge now would be acknowledged by the old bit";
  EXPECT_EQ(handshake.step(0, t0), both);
}

TEST(SetPointHandshake, ANewerTargetDuringTheHandshakeWaitsAndTheNewestWins) {
  SetPointHandshake handshake;
  handshake.request(1);
  handshake.step(0, t0);
  handshake.step(0, t0);
  handshake.request(2);
  handshake.request(3);
  EXPECT_EQ(handshake.target(), 1) << "the target does not change under a raised bit";
  EXPECT_EQ(handshake.step(set_point_acknowledge_bit, t0), none);
  EXPECT_FALSE(handshake.settled());
  EXPECT_EQ(handshake.step(0, t0), none);
  EXPECT_EQ(handshake.target(), 3);
  EXPECT_EQ(handshake.step(0, t0), both);
}

TEST(SetPointHandshake, ADriveThatDoesNotAnswerIsOverdue) {
  SetPointHandshake handshake;
  EXPECT_FALSE(handshake.overdue(t0 + 1h, 500ms)) << "nothing was asked";
  handshake.request(1);
  handshake.step(0, t0);
  handshake.step(0, t0 + 5ms);
  EXPECT_FALSE(handshake.overdue(t0 + 505ms, 500ms));
  EXPECT_TRUE(handshake.overdue(t0 + 506ms, 500ms));
  handshake.restart();
  EXPECT_FALSE(handshake.overdue(t0 + 1h, 500ms));
  EXPECT_TRUE(handshake.settled());
}

}  // namespace
}  // namespace hogline::hw::test
