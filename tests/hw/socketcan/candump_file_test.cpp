#include "hw/socketcan/candump_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <system_error>

#include "hw/socketcan/logged_bus.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

class CandumpFileTest : public testing::Test {
 protected:
  ~CandumpFileTest() override { std::remove(path_.c_str()); }

  CandumpLog read() const {
    std::ifstream file(path_);
    return read_candump_log(file);
  }

  const std::string path_ = testing::TempDir() + "hogline_candump_" + std::to_string(getpid()) + ".log";
};

TEST_F(CandumpFileTest, HoldsEveryRecordInOrderWhenItHasGone) {
  constexpr std::uint32_t count = 5000;
  {
    CandumpFile file(path_);
    for (std::uint32_t i = 0; i < count; ++i) file.record({i * 1us, "can0", {.id = i % 0x800}});
    EXPECT_EQ(file.lost(), 0U);
  }
  const CandumpLog log = read();
  EXPECT_TRUE(log.refused.empty());
  ASSERT_EQ(log.records.size(), count);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(log.records[i].unix_time, i * 1us);
}

TEST_F(CandumpFileTest, AFullQueueLosesLinesAndCountsThem) {
  std::uint64_t lost = 0;
  {
    CandumpFile file(path_, 1);
    for (int i = 0; i < 10000; ++i) file.record({i * 1us, "can0", {.id = 1}});
    lost = file.lost();
  }
  EXPECT_GT(lost, 0U);
  EXPECT_EQ(read().records.size() + lost, 10000U);
}

TEST_F(CandumpFileTest, AFullDiskLosesLinesAndCountsThem) {
  CandumpFile file("/dev/full");
  file.record({1us, "can0", {.id = 1}});
  while (file.lost() == 0) std::this_thread::yield();
  EXPECT_EQ(file.lost(), 1U);
}

TEST_F(CandumpFileTest, AFolderThatDoesNotExistIsAnError) {
  EXPECT_THROW(CandumpFile("/nonexistent/folder/can.log"), std::system_error);
}

struct OneFrameBus final : CanBus {
  CanSendResult answer = CanSendResult::sent;
  std::optional<StampedCanFrame> waiting;
  CanSendResult send(const CanFrame&) override { return answer; }
  std::optional<StampedCanFrame> receive() override { return std::exchange(waiting, std::nullopt); }
  bool up() const override { return true; }
};

struct Collector final : CanTap {
  std::vector<CandumpRecord> records;
  void record(const CandumpRecord& record) override { records.push_back(record); }
};

TEST(LoggedBus, RecordsWhatWasSentAndReceivedAndNotWhatWasRefused) {
  OneFrameBus inner;
  SteppedClock clock;
  Collector log;
  LoggedBus bus(inner, clock, log, "sim0", 1700000000s);
  clock.advance(3ms);

  EXPECT_EQ(bus.send({.id = 0x201}), CanSendResult::sent);
  inner.answer = CanSendResult::would_block;
  EXPECT_EQ(bus.send({.id = 0x202}), CanSendResult::would_block);
  inner.waiting = StampedCanFrame{{.id = 0x181}, Stamp{} + 2ms};
  EXPECT_TRUE(bus.receive());
  EXPECT_FALSE(bus.receive());

  ASSERT_EQ(log.records.size(), 2U);
  EXPECT_EQ(encode_candump_line(log.records[0]), "(1700000000.003000) sim0 201# T");
  EXPECT_EQ(encode_candump_line(log.records[1]), "(1700000000.002000) sim0 181# R");
}

}  // namespace
