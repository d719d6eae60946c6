// Golden lines are can-utils' own output (candump 2020.11, -L and -L -x).
#include "hw/socketcan/candump_log.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>

using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

CandumpRecord golden(CanFrame frame) { return {1795302065s + 451912us, "vcan0", frame}; }

struct Golden {
  std::string what;
  std::string line;
  CandumpRecord record;
};

std::vector<Golden> golden_lines() {
  const std::string time = "(1795302065.451912) vcan0 ";
  CandumpRecord bus_off = golden({.id = 0x40, .length = 8});
  bus_off.error_frame = true;
  CandumpRecord sent = golden({.id = 0x123, .length = 2, .data = {0x11, 0x22}});
  sent.direction = CanDirection::transmitted;
  CandumpRecord received = golden({.id = 0x123, .remote = true, .length = 5});
  received.direction = CanDirection::received;
  return {
      {"sdo", time + "601#4041600000000000", golden({.id = 0x601, .length = 8, .data = {0x40, 0x41, 0x60}})},
      {"nmt", time + "000#0105", golden({.id = 0, .length = 2, .data = {1, 5}})},
      {"no data", time + "080#", golden({.id = 0x80})},
      {"remote", time + "123#R", golden({.id = 0x123, .remote = true})},
      {"extended", time + "00000123#FF", golden({.id = 0x123, .extended = true, .length = 1, .data = {0xFF}})},
      {"error frame", time + "20000040#0000000000000000", bus_off},
      {"transmitted", time + "123#1122 T", sent},
      {"received remote with a length", time + "123#R5 R", received},
  };
}

TEST(CandumpLine, GoldenLinesBothWays) {
  for (const Golden& golden : golden_lines()) {
    EXPECT_EQ(encode_candump_line(golden.record), golden.line) << golden.what;
    const CandumpLine decoded = decode_candump_line(golden.line);
    ASSERT_TRUE(decoded.record) << golden.what << ": " << decoded.reason;
    EXPECT_EQ(*decoded.record, golden.record) << golden.what;
  }
}

TEST(CandumpLine, EveryRecordComesBack) {
  EXPECT_TRUE(rc::check("decode(encode(record)) == record", [] {
    CandumpRecord record;
    record.unix_time = std::chrono::microseconds(*rc::gen::inRange<std::int64_t>(0, 9'999'999'999'999'999));
    record.interface = *rc::gen::element<std::string>("can0", "vcan0", "slcan12", "fifteen_letters");
    record.error_frame = *rc::gen::arbitrary<bool>();
    record.frame.extended = !record.error_frame && *rc::gen::arbitrary<bool>();
    const bool eight_digits = record.frame.extended || record.error_frame;
    record.frame.id = *rc::gen::inRange<std::uint32_t>(0, eight_digits ? 0x20000000 : 0x800);
    record.frame.remote = !record.error_frame && *rc::gen::arbitrary<bool>();
    record.frame.length = *rc::gen::inRange<std::uint8_t>(0, 9);
    for (std::uint8_t i = 0; i < record.frame.length && !record.frame.remote; ++i)
      record.frame.data[i] = *rc::gen::arbitrary<std::uint8_t>();
    record.direction = *rc::gen::element(CanDirection::unknown, CanDirection::received, CanDirection::transmitted);

    const CandumpLine decoded = decode_candump_line(encode_candump_line(record) + "\r\n");
    RC_ASSERT(decoded.record.has_value());
    RC_ASSERT(*decoded.record == record);
  }));
}

TEST(CandumpLine, AnyBytesGiveARecordOrAReason) {
  EXPECT_TRUE(rc::check("a golden line with any one byte changed", [] {
    const auto lines = golden_lines();
    std::string line = lines[*rc::gen::inRange<std::size_t>(0, lines.size())].line;
    line[*rc::gen::inRange<std::size_t>(0, line.size())] = *rc::gen::arbitrary<char>();
    const CandumpLine decoded = decode_candump_line(line);
    RC_ASSERT(decoded.record.has_value() == decoded.reason.empty());
    if (decoded.record) RC_ASSERT(decoded.record->frame.length <= 8);
  }));
}

TEST(CandumpLine, WhatIsNoLineIsRefusedWithAReason) {
  const std::string time = "(1795302065.451912) ";
  for (const std::string& line : {std::string(),
                                  std::string("("),
                                  std::string("1795302065.451912 vcan0 123#"),
                                  std::string("(1795302065.45191) vcan0 123#"),
                                  std::string("(-5.451912) vcan0 123#"),
                                  std::string("(99999999999999999999.451912) vcan0 123#"),
                                  time + "vcan0",
                                  time + " 123#",
                                  time + "sixteen_letters_ 123#",
                                  time + std::string("vc\x01\0an0", 7) + " 123#",  // found by fuzzing
                                  time + "vc\tan0 123#",
                                  time + "vcan0 1234#",
                                  time + "vcan0 800#",
                                  time + "vcan0 40000001#",
                                  time + "vcan0 12G#",
                                  time + "vcan0 123",
                                  time + "vcan0 123#1",
                                  time + "vcan0 123#112233445566778899",
                                  time + "vcan0 123#1 2",
                                  time + "vcan0 123#R9",
                                  time + "vcan0 123#R55",
                                  time + "vcan0 20000040#R",
                                  time + "vcan0 123##1AABB",
                                  time + "vcan0 123#11 X",
                                  time + "vcan0 123#11 T "}) {
    const CandumpLine decoded = decode_candump_line(line);
    EXPECT_FALSE(decoded.record) << line;
    EXPECT_FALSE(decoded.reason.empty()) << line;
  }
}

TEST(CandumpLog, AKilledWritersLastLineIsListed) {
  std::istringstream file("(1.000000) can0 080#\n\n(1.000100) can0 181#0102\n(1.0002");
  const CandumpLog log = read_candump_log(file);
  EXPECT_EQ(log.records.size(), 2U);
  ASSERT_EQ(log.refused.size(), 1U);
  EXPECT_EQ(log.refused[0].line, 4U);
}

}  // namespace
