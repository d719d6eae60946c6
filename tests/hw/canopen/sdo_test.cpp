// The SDO client against golden traces of an independent implementation (node 5), and every way an answer can be wrong.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "hw/canopen/sdo_client.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;
using Outcome = SdoResult::Outcome;

constexpr Stamp t0{100s};

/// Plays a trace "request answer request answer ..." and returns the result.
SdoResult play(SdoClient& client, const std::vector<std::pair<std::string, std::string>>& trace) {
  for (const auto& [request, answer] : trace) {
    const std::optional<CanFrame> sent = client.take_frame();
    EXPECT_TRUE(sent.has_value()) << "no request where " << request << " is due";
    if (sent) {
      EXPECT_EQ(text(*sent), request);
    }
    client.on_frame(frame(answer), t0);
  }
  return client.take_result().value_or(SdoResult{Outcome::timeout, {}, 0, {}});
}

struct DownloadRow {
  SdoWrite write;
  const char* request;
  const char* answer;
};

TEST(SdoClient, GoldenDownloads) {
  const DownloadRow rows[] = {
      {{{0x6060, 0}, 9, 1}, "605#2F60600009000000", "585#6060600000000000"},
      {{{0x6040, 0}, 6, 2}, "605#2B40600006000000", "585#6040600000000000"},
      {{{0x60FF, 0}, static_cast<std::uint32_t>(-1000), 4}, "605#23FF600018FCFFFF", "585#60FF600000000000"},
  };
  for (const DownloadRow& row : rows) {
    SdoClient client(5, 100ms);
    client.start_download(row.write, t0);
    EXPECT_EQ(play(client, {{row.request, row.answer}}).outcome, Outcome::ok) << row.request;
    EXPECT_FALSE(client.take_frame()) << "nothing more to say";
  }
}

TEST(SdoClient, GoldenExpeditedUpload) {
  SdoClient client(5, 100ms);
  client.start_upload({0x60FF, 0}, t0);
  const SdoResult result = play(client, {{"605#40FF600000000000", "585#43FF600018FCFFFF"}});
  EXPECT_EQ(result.outcome, Outcome::ok);
  EXPECT_EQ(static_cast<std::int32_t>(result.value().value()), -1000);
}

TEST(SdoClient, GoldenSegmentedUpload) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1008, 0}, t0);
  const SdoResult result = play(client, {{"605#4008100000000000", "585#410810000F000000"},
                                         {"605#6000000000000000", "585#004355524C494E47"},
                                         {"605#7000000000000000", "585#1020445249564520"},
                                         {"605#6000000000000000", "585#0D31000000000000"}});
  EXPECT_EQ(result.outcome, Outcome::ok);
  EXPECT_EQ(std::string(result.data.begin(), result.data.end()), "CURLING DRIVE 1");
}

TEST(SdoClient, GoldenAbort) {
  SdoClient client(5, 100ms);
  client.start_download({{0x1000, 0}, 0, 4}, t0);
  const SdoResult result = play(client, {{"605#2300100000000000", "585#8000100002000106"}});
  EXPECT_EQ(result.outcome, Outcome::aborted);
  EXPECT_EQ(result.abort_code, 0x06010002u);
  EXPECT_EQ(result.describe(), "SDO 1000:00: aborted 06010002, attempt to write a read-only object");
}

struct WrongAnswer {
  const char* description;
  const char* answer;
};

TEST(SdoClient, AWrongAnswerToADownloadBreaksTheTransferAndAbortsIt) {
  const WrongAnswer rows[] = {{"echo of another object", "585#6040600000000000"},
                              {"echo of another sub-index", "585#6060600100000000"},
                              {"answer to an upload", "585#4360600009000000"},
                              {"a segment", "585#0D31000000000000"},
                              {"a command that no server sends", "585#E060600000000000"},
                              {"abort of another object", "585#8000100002000106"},
                              {"seven bytes", "585#60606000000000"}};
  for (const WrongAnswer& row : rows) {
    SdoClient client(5, 100ms);
    client.start_download({{0x6060, 0}, 9, 1}, t0);
    EXPECT_EQ(play(client, {{"605#2F60600009000000", row.answer}}).outcome, Outcome::protocol) << row.description;
    const std::optional<CanFrame> abort = client.take_frame();
    ASSERT_TRUE(abort) << row.description;
    EXPECT_EQ(text(*abort), "605#8060600001000405") << row.description;
  }
}

TEST(SdoClient, AToggleBitNotAlternatedAborts) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1008, 0}, t0);
  const SdoResult result = play(client, {{"605#4008100000000000", "585#410810000F000000"},
                                         {"605#6000000000000000", "585#004355524C494E47"},
                                         {"605#7000000000000000", "585#0020445249564520"}});
  EXPECT_EQ(result.outcome, Outcome::protocol);
  EXPECT_EQ(result.abort_code, sdo_abort_toggle);
  EXPECT_EQ(text(client.take_frame().value()), "605#8008100000000305");
}

TEST(SdoClient, MoreOrFewerBytesThanAnnouncedAbort) {
  for (const char* announced : {"585#4108100003000000", "585#4108100009000000"}) {
    SdoClient client(5, 100ms);
    client.start_upload({0x1008, 0}, t0);
    const SdoResult result =
        play(client, {{"605#4008100000000000", announced}, {"605#6000000000000000", "585#014355524C494E47"}});
    EXPECT_EQ(result.outcome, Outcome::protocol) << announced;
    EXPECT_EQ(result.abort_code, sdo_abort_length) << announced;
  }
}

TEST(SdoClient, AnEndlessUploadEnds) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1008, 0}, t0);
  client.on_frame(frame("585#4008100000000000"), t0);  // segmented, size not said
  bool toggle = false;
  for (int i = 0; i < 1000 && client.busy(); ++i, toggle = !toggle) {
    client.on_frame(frame(toggle ? "585#1041414141414141" : "585#0041414141414141"), t0);
  }
  EXPECT_EQ(client.take_result().value().outcome, Outcome::protocol);
}

TEST(SdoClient, SilenceEndsInATimeoutAndAnAbort) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1000, 0}, t0);
  static_cast<void>(client.take_frame());
  client.step(t0 + 99ms);
  EXPECT_FALSE(client.take_result());
  client.step(t0 + 100ms);
  EXPECT_EQ(client.take_result().value().outcome, Outcome::timeout);
  EXPECT_EQ(text(client.take_frame().value()), "605#8000100000000405");
  client.on_frame(frame("585#4300100092010200"), t0 + 120ms);  // late: nobody waits for it
  EXPECT_FALSE(client.take_result());
}

TEST(SdoClient, EachSegmentHasItsOwnDeadline) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1008, 0}, t0);
  client.on_frame(frame("585#410810000F000000"), t0 + 90ms);
  client.step(t0 + 150ms);
  EXPECT_TRUE(client.busy());
  client.step(t0 + 190ms);
  EXPECT_FALSE(client.busy());
}

TEST(SdoClient, ExpeditedWithoutSizeGivesFourBytes) {
  SdoClient client(5, 100ms);
  client.start_upload({0x6041, 0}, t0);
  const SdoResult result = play(client, {{"605#4041600000000000", "585#4241600027020000"}});
  EXPECT_EQ(result.value().value(), 0x227u);
}

TEST(SdoAbort, EveryListedCodeHasItsMeaning) {
  for (const std::uint32_t code :
       {0x05030000u, 0x05040000u, 0x05040001u, 0x06010000u, 0x06010001u, 0x06010002u, 0x06020000u, 0x06040041u,
        0x06040042u, 0x06060000u, 0x06070010u, 0x06090011u, 0x06090030u, 0x06090031u, 0x06090032u, 0x08000000u,
        0x08000020u, 0x08000021u, 0x08000022u}) {
    EXPECT_STRNE(sdo_abort_meaning(code), sdo_abort_meaning(0x12345678)) << std::hex << code;
  }
}

RC_GTEST_PROP(SdoCodec, DownloadKeepsAddressSizeAndValue,
              (std::uint16_t index, std::uint8_t sub, std::uint32_t value)) {
  const auto size = *rc::gen::inRange<std::uint8_t>(1, 5);
  const CanFrame request = sdo_download_frame(5, {{index, sub}, value, size});
  RC_ASSERT(request.length == 8);
  RC_ASSERT(4 - ((request.data[0] >> 2) & 3) == size);
  RC_ASSERT((request.data[1] | (request.data[2] << 8)) == index);
  RC_ASSERT(request.data[3] == sub);
  std::uint32_t read = 0;
  for (std::size_t i = 4; i-- > 0;) read = (read << 8) | request.data[4 + i];
  RC_ASSERT(read == (size == 4 ? value : value & ((1u << (8 * size)) - 1)));
}

RC_GTEST_PROP(SdoCodec, AnyEightBytesAreDecodedWithoutHarm, (std::array<std::uint8_t, 8> bytes)) {
  SdoClient client(5, 100ms);
  client.start_upload({0x1008, 0}, t0);
  client.on_frame(CanFrame{.id = 0x585, .length = 8, .data = bytes}, t0);
  client.on_frame(CanFrame{.id = 0x585, .length = 8, .data = bytes}, t0);
  if (const auto result = client.take_result()) RC_ASSERT(!result->describe().empty());
}

}  // namespace
}  // namespace hogline::hw::test
