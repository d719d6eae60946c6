// Golden traces byte for byte between our SDO client and a foreign node, and what a third program saw of them.
#include <array>
#include <fstream>
#include <utility>

#include "hw/socketcan/candump_log.hpp"
#include "tests/hil/python_node.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

// Request and answer: writes of 1, 2 and 4 bytes, a read, a segmented read of 15 bytes, an abort.
using Exchange = std::pair<const char*, const char*>;
constexpr std::array<Exchange, 9> golden_trace{{
    {"605#2F60600009000000", "585#6060600000000000"},
    {"605#2B40600006000000", "585#6040600000000000"},
    {"605#23FF600018FCFFFF", "585#60FF600000000000"},
    {"605#40FF600000000000", "585#43FF600018FCFFFF"},
    {"605#4008100000000000", "585#410810000F000000"},
    {"605#6000000000000000", "585#004355524C494E47"},
    {"605#7000000000000000", "585#1020445249564520"},
    {"605#6000000000000000", "585#0D31000000000000"},
    {"605#2300100000000000", "585#8000100002000106"},
}};

TEST_F(PythonNode, AnswersTheGoldenTraceByteForByte) {
  SocketCanBus bus = running_bus();
  for (const auto& [request, expected] : golden_trace) {
    ASSERT_EQ(bus.send(frame(request)), CanSendResult::sent);
    EXPECT_EQ(answer(bus), expected) << request;
  }

  ASSERT_EQ(bus.send(frame("605#2B17100014000000")), CanSendResult::sent) << "heartbeat every 20 ms";
  EXPECT_TRUE(heard(bus, "705#7F"));
  ASSERT_EQ(bus.send(frame("000#0105")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#05"));
  ASSERT_EQ(bus.send(frame("000#0205")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#04"));
  ASSERT_EQ(bus.send(frame("000#8205")), CanSendResult::sent);
  EXPECT_TRUE(heard(bus, "705#00")) << "reset communication boots anew";
}

TEST_F(PythonNode, OurSdoClientTalksToIt) {
  SocketCanBus bus = running_bus({.receive = {{0x585}, {0x705}}});
  SdoClient client(5, generous);

  client.start_upload({0x1000, 0}, now());
  EXPECT_EQ(transfer(bus, client, 5).value(), 0x00020192U);
  client.start_upload({0x1008, 0}, now());
  const SdoResult name = transfer(bus, client, 5);
  EXPECT_EQ(std::string(name.data.begin(), name.data.end()), "CURLING DRIVE 1");
  client.start_download({{0x60FF, 0}, static_cast<std::uint32_t>(-1000), 4}, now());
  EXPECT_EQ(transfer(bus, client, 5).outcome, SdoResult::Outcome::ok);
  client.start_upload({0x60FF, 0}, now());
  EXPECT_EQ(transfer(bus, client, 5).value(), static_cast<std::uint32_t>(-1000));

  struct Refusal {
    SdoWrite write;
    std::uint32_t code;
  };
  for (const Refusal& refusal : {Refusal{{{0x1000, 0}, 1, 4}, 0x06010002}, Refusal{{{0x5FFF, 0}, 1, 4}, 0x06020000},
                                 Refusal{{{0x1018, 9}, 1, 4}, 0x06090011}, Refusal{{{0x6040, 0}, 6, 4}, 0x06070010},
                                 Refusal{{{0x6060, 0}, 3, 1}, 0x06090030}}) {
    client.start_download(refusal.write, now());
    const SdoResult result = transfer(bus, client, 5);
    EXPECT_EQ(result.outcome, SdoResult::Outcome::aborted);
    EXPECT_EQ(result.abort_code, refusal.code) << result.describe();
  }
}

// Requests and answers as a third program saw them.
TEST_F(PythonNode, CandumpReadsTheGoldenTraceOfOurClientAndThisNode) {
  SocketCanBus bus = running_bus({.receive = {{0x585}}, .own = {{0x605}}});
  Process candump({"candump", "-L", "vcan0,605:7FF,585:7FF"}, "/run/golden.log");
  const auto lines = [] {
    std::ifstream file("/run/golden.log");
    std::vector<std::string> seen;
    for (const CandumpRecord& record : read_candump_log(file).records) seen.push_back(text(record.frame));
    return seen;
  };
  ASSERT_TRUE(wait_until(
      [&] {  // until it listens
        static_cast<void>(bus.send(frame("605#8000000000000405")));
        period(bus);
        return !lines().empty();
      },
      generous, 50ms));

  SdoClient client(5, generous);
  for (const SdoWrite& write : {SdoWrite{{0x6060, 0}, 9, 1}, SdoWrite{{0x6040, 0}, 6, 2},
                                SdoWrite{{0x60FF, 0}, static_cast<std::uint32_t>(-1000), 4}}) {
    client.start_download(write, now());
    EXPECT_EQ(transfer(bus, client, 5).outcome, SdoResult::Outcome::ok);
  }
  for (const ObjectAddress address : {ObjectAddress{0x60FF, 0}, ObjectAddress{0x1008, 0}}) {
    client.start_upload(address, now());
    EXPECT_EQ(transfer(bus, client, 5).outcome, SdoResult::Outcome::ok);
  }
  client.start_download({{0x1000, 0}, 0, 4}, now());
  EXPECT_EQ(transfer(bus, client, 5).outcome, SdoResult::Outcome::aborted);

  std::vector<std::string> golden;
  for (const auto& [request, expected] : golden_trace) golden.insert(golden.end(), {request, expected});
  std::vector<std::string> seen;
  ASSERT_TRUE(wait_until([&] {
    seen = lines();
    std::erase(seen, "605#8000000000000405");
    return seen.size() >= golden.size();
  }));
  EXPECT_EQ(seen, golden);
}

}  // namespace
