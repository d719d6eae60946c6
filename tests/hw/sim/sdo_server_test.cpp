// The simulated SDO server against the same golden traces (node 5), and its abort codes.
#include "hw/sim/sdo_server.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

using sim::ObjectAccess;

class SdoServerTest : public testing::Test {
 protected:
  SdoServerTest() {
    objects.add(0x1000, 0, 4, ObjectAccess::constant, 0x00020192);
    objects.add_string(0x1008, 0, "CURLING DRIVE 1");
    objects.add(0x6060, 0, 1, ObjectAccess::read_write);
    objects.add(0x6040, 0, 2, ObjectAccess::read_write);
    objects.add(0x60FF, 0, 4, ObjectAccess::read_write);
    objects.add(0x2000, 0, 2, ObjectAccess::write_only);
    objects.add(0x2001, 0, 1, ObjectAccess::read_write).guard = [](std::int64_t value) -> std::uint32_t {
      return value > 9 ? 0x06090031 : value < 0 ? 0x06090032 : 0;
    };
  }

  std::string ask(const std::string& request) {
    const auto answer = server.on_request(frame(request));
    return answer ? text(*answer) : "";
  }

  sim::ObjectDictionary objects;
  sim::SdoServer server{5, objects};
};

TEST_F(SdoServerTest, GoldenTraces) {
  const std::pair<const char*, const char*> trace[] = {
      {"605#2F60600009000000", "585#6060600000000000"}, {"605#2B40600006000000", "585#6040600000000000"},
      {"605#23FF600018FCFFFF", "585#60FF600000000000"}, {"605#40FF600000000000", "585#43FF600018FCFFFF"},
      {"605#4008100000000000", "585#410810000F000000"}, {"605#6000000000000000", "585#004355524C494E47"},
      {"605#7000000000000000", "585#1020445249564520"}, {"605#6000000000000000", "585#0D31000000000000"},
      {"605#2300100000000000", "585#8000100002000106"},
  };
  for (const auto& [request, answer] : trace) EXPECT_EQ(ask(request), answer) << request;
  EXPECT_EQ(objects.get(0x6060), 9u);
  EXPECT_EQ(objects.get_signed(0x60FF), -1000);
}

TEST_F(SdoServerTest, AbortCodes) {
  const std::pair<const char*, const char*> rows[] = {
      {"605#4000200000000000", "585#8000200001000106"},  // read of a write-only object
      {"605#4055550000000000", "585#8055550000000206"},  // no such object
      {"605#4000100500000000", "585#8000100511000906"},  // no such sub-index
      {"605#2B60600009000000", "585#8060600010000706"},  // wrong length
      {"605#2F0120000A000000", "585#8001200031000906"},  // too high
      {"605#2F012000FF000000", "585#8001200032000906"},  // too low
      {"605#6000000000000000", "585#8001200001000405"},  // a segment of nothing
      {"605#E000000000000000", "585#8001200001000405"},  // unknown command
  };
  for (const auto& [request, answer] : rows) EXPECT_EQ(ask(request), answer) << request;
}

TEST_F(SdoServerTest, AWrongToggleBitAborts) {
  static_cast<void>(ask("605#4008100000000000"));
  EXPECT_EQ(ask("605#7000000000000000"), "585#8008100000000305");
}

TEST_F(SdoServerTest, SegmentedDownload) {
  EXPECT_EQ(ask("605#21FF600004000000"), "585#60FF600000000000");
  EXPECT_EQ(ask("605#0718FCFFFF000000"), "585#2000000000000000");
  EXPECT_EQ(objects.get_signed(0x60FF), -1000);
}

TEST_F(SdoServerTest, AnAbortOfTheClientIsNotAnswered) { EXPECT_EQ(ask("605#8008100000000405"), ""); }

RC_GTEST_FIXTURE_PROP(SdoServerTest, AnyRequestIsAnsweredWithEightBytesOrNothing,
                      (std::vector<std::array<std::uint8_t, 8>> requests)) {
  for (const auto& bytes : requests) {
    const auto answer = server.on_request(CanFrame{.id = 0x605, .length = 8, .data = bytes});
    if (answer) RC_ASSERT(answer->length == 8 && answer->id == 0x585u);
  }
}

}  // namespace
}  // namespace hogline::hw::test
