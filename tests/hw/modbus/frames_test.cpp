// Modbus bytes: the golden RTU frames of the maker's manual, the same over TCP, and every way an answer can be wrong.
#include "hw/modbus/modbus_frames.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <sstream>

namespace hogline::hw::modbus {
namespace {

using Bytes = std::vector<std::uint8_t>;

// "09 04 07D0" to bytes.
Bytes hex(const std::string& text) {
  std::string digits;
  std::ranges::copy_if(text, std::back_inserter(digits), [](char c) { return c != ' '; });
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

const Request status = read_input_registers(9, 0x07D0, 3);

TEST(ModbusFrames, requests_are_the_makers_byte_for_byte) {
  const struct {
    const char* what;
    Request request;
    const char* golden;
  } cases[] = {
      {"activate", write_registers(9, 0x03E8, std::vector<std::uint16_t>{0x0100, 0, 0}),
       "09 10 03E8 0003 06 0100 0000 0000 72E1"},
      {"open fast", write_registers(9, 0x03E8, std::vector<std::uint16_t>{0x0900, 0, 0xFFFF}),
       "09 10 03E8 0003 06 0900 0000 FFFF 7219"},
      {"status", status, "09 04 07D0 0003 B1CE"},
  };
  for (const auto& c : cases) EXPECT_EQ(encode(c.request, Framing::rtu, 0), hex(c.golden)) << c.what;
}

TEST(ModbusFrames, answers_of_the_makers_are_good_byte_for_byte) {
  const auto gripped = judge(hex("09 04 06 B900 00FF BD00 5C9A"), status, Framing::rtu, 0);
  EXPECT_EQ(gripped.verdict, Verdict::good) << gripped.reason;
  EXPECT_EQ(gripped.values, (std::vector<std::uint16_t>{0xB900, 0x00FF, 0xBD00}));
  const auto open = judge(hex("09 04 06 F900 0000 0D00 17AA"), status, Framing::rtu, 0);
  EXPECT_EQ(open.verdict, Verdict::good) << open.reason;
  EXPECT_EQ(open.values, (std::vector<std::uint16_t>{0xF900, 0x0000, 0x0D00}));
}

TEST(ModbusFrames, tcp_has_the_header_of_the_standard) {
  EXPECT_EQ(encode(status, Framing::tcp, 0x1501), hex("1501 0000 0006 09 04 07D0 0003"));
  const auto answer = judge(hex("1501 0000 0009 09 04 06 B900 00FF BD00"), status, Framing::tcp, 0x1501);
  EXPECT_EQ(answer.verdict, Verdict::good) << answer.reason;
  EXPECT_EQ(answer.values, (std::vector<std::uint16_t>{0xB900, 0x00FF, 0xBD00}));
}

TEST(ModbusFrames, what_does_not_answer_the_request_is_wrong) {
  const Request write = write_registers(9, 0x03E8, std::vector<std::uint16_t>{0x0100, 0, 0});
  const struct {
    const char* what;
    Request request;
    Framing framing;
    const char* bytes;
  } cases[] = {
      {"another transaction", status, Framing::tcp, "0002 0000 0009 09 04 06 B900 00FF BD00"},
      {"another protocol", status, Framing::tcp, "0001 0001 0009 09 04 06 B900 00FF BD00"},
      {"too long in the header", status, Framing::tcp, "0001 0000 000A 09 04 06 B900 00FF BD00"},
      {"another unit", status, Framing::tcp, "0001 0000 0009 0A 04 06 B900 00FF BD00"},
      {"another function", status, Framing::tcp, "0001 0000 0009 09 03 06 B900 00FF BD00"},
      {"an exception of another function", status, Framing::tcp, "0001 0000 0003 09 90 02"},
      {"another byte count", status, Framing::tcp, "0001 0000 0009 09 04 04 B900 00FF BD00"},
      {"a byte more", status, Framing::tcp, "0001 0000 0009 09 04 06 B900 00FF BD00 00"},
      {"another address confirmed", write, Framing::tcp, "0001 0000 0006 09 10 03E9 0003"},
      {"another count confirmed", write, Framing::tcp, "0001 0000 0006 09 10 03E8 0002"},
      {"a wrong CRC", status, Framing::rtu, "09 04 06 B900 00FF BD00 5C9B"},
      {"a damaged register", status, Framing::rtu, "09 04 06 B900 00FE BD00 5C9A"},
      {"another unit", status, Framing::rtu, "0A"},
      {"another function", status, Framing::rtu, "09 03"},
      {"another byte count", status, Framing::rtu, "09 04 02"},
      {"its own echo", status, Framing::rtu, "09 04 07D0 0003 B1CE"},
      {"its own echo", write, Framing::rtu, "09 10 03E8 0003 06 0100 0000 0000 72E1"},
      {"a byte more", status, Framing::rtu, "09 04 06 B900 00FF BD00 5C9A 00"},
  };
  for (const auto& c : cases) {
    const auto answer = judge(hex(c.bytes), c.request, c.framing, 1);
    EXPECT_EQ(answer.verdict, Verdict::wrong) << c.what;
    EXPECT_FALSE(answer.reason.empty()) << c.what;
  }
}

TEST(ModbusFrames, exceptions_are_told_with_their_code) {
  const auto tcp = judge(hex("0001 0000 0003 09 84 0B"), status, Framing::tcp, 1);
  EXPECT_EQ(tcp.verdict, Verdict::exception);
  EXPECT_EQ(tcp.exception, 11);
  const auto answer = judge(hex("09 84 02 4303"), status, Framing::rtu, 0);
  EXPECT_EQ(answer.verdict, Verdict::exception) << answer.reason;
  EXPECT_EQ(answer.exception, 2);
}

TEST(ModbusFrames, each_listed_exception_has_words) {
  for (const int code : {1, 2, 3, 4, 5, 6, 8, 10, 11})
    EXPECT_NE(exception_meaning(code), exception_meaning(99)) << code;
}

TEST(ModbusFrames, every_beginning_of_a_good_answer_is_incomplete) {
  for (const auto& [framing, text] : {std::pair{Framing::rtu, "09 04 06 B900 00FF BD00 5C9A"},
                                      std::pair{Framing::tcp, "0001 0000 0009 09 04 06 B900 00FF BD00"}}) {
    const Bytes whole = hex(text);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_EQ(judge({whole.data(), size}, status, framing, 1).verdict, Verdict::incomplete) << size;
    }
  }
}

RC_GTEST_PROP(ModbusFrames, one_damaged_byte_of_an_rtu_answer_is_never_good, ()) {
  Bytes bytes = hex("09 04 06 B900 00FF BD00 5C9A");
  const auto place = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ *rc::gen::inRange(1, 256));
  RC_ASSERT(judge(bytes, status, Framing::rtu, 0).verdict != Verdict::good);
}

RC_GTEST_PROP(ModbusFrames, any_bytes_get_a_verdict_and_a_good_one_has_all_registers, ()) {
  const auto framing = *rc::gen::element(Framing::tcp, Framing::rtu);
  const auto bytes = *rc::gen::arbitrary<Bytes>();
  const auto answer = judge(bytes, status, framing, 1);
  RC_ASSERT(answer.verdict != Verdict::good || answer.values.size() == 3U);
  RC_ASSERT((answer.verdict == Verdict::wrong) == !answer.reason.empty());
}

}  // namespace
}  // namespace hogline::hw::modbus
