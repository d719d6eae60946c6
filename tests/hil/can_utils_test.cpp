// can-utils as foreign readers and writers of our bus and of our log format.
#include <fstream>

#include "hw/socketcan/candump_file.hpp"
#include "hw/socketcan/replay_bus.hpp"
#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

class CanUtils : public VcanTest {
 protected:
  static CandumpLog read(const std::string& path) {
    std::ifstream file(path);
    return read_candump_log(file);
  }
  std::string path(const std::string& file) const { return "/run/" + file; }
};

// A mixed conversation, with the tap's log in `file`.
void converse(SocketCanBus& bus, CanNode& node, const std::string& file) {
  CandumpFile log(file);
  bus.set_tap(&log);
  for (std::uint8_t i = 0; i < 50; ++i) {
    EXPECT_EQ(bus.send({.id = 0x605, .length = 8, .data = {0x40, i, 0x10}}), CanSendResult::sent);
    node.send(0x585, {0x43, i, 0x10, 0, 1, 2, 3, 4});
    EXPECT_EQ(receive(bus, 1).size(), 1U);
  }
  EXPECT_EQ(bus.send({.id = 0x18FF0001, .extended = true, .length = 1, .data = {0xA5}}), CanSendResult::sent);
  EXPECT_EQ(bus.send({.id = 0x705, .remote = true}), CanSendResult::sent);
  node.send(CAN_ERR_FLAG | 0x04, {0, 0x20, 0, 0, 0, 0, 128, 0});
  EXPECT_TRUE(run_until(bus, [&] {
    return bus.state().counters.confirmed == bus.state().counters.sent &&
           bus.state().controller == CanControllerState::passive;
  }));
  bus.set_tap(nullptr);
}

TEST_F(CanUtils, CandumpSeesTheSameFramesAtTheSameTimesAsOurLog) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  Process candump({"candump", "-L", name_ + ",0:0,#FFFFFFFF"}, path("theirs.log"));
  ASSERT_TRUE(wait_until([&] {  // until it listens
    node.send(0x7FF);
    return !read(path("theirs.log")).records.empty();
  }));
  period(bus);
  converse(bus, node, path("ours.log"));
  node.send(0x7FE);
  ASSERT_TRUE(wait_until([&] {
    const auto theirs = read(path("theirs.log")).records;
    return !theirs.empty() && theirs.back().frame.id == 0x7FE;
  }));

  auto theirs = read(path("theirs.log"));
  EXPECT_TRUE(theirs.refused.empty()) << "our reader reads all of candump's lines";
  std::erase_if(theirs.records, [](const CandumpRecord& r) { return (r.frame.id & 0x7FE) == 0x7FE; });
  auto ours = read(path("ours.log"));
  EXPECT_TRUE(ours.refused.empty());
  const auto by_time = [](const CandumpRecord& a, const CandumpRecord& b) { return a.unix_time < b.unix_time; };
  std::stable_sort(ours.records.begin(), ours.records.end(), by_time);
  ASSERT_EQ(ours.records.size(), theirs.records.size());
  for (std::size_t i = 0; i < ours.records.size(); ++i) {
    CandumpRecord unmarked = ours.records[i];
    unmarked.direction = CanDirection::unknown;
    EXPECT_EQ(encode_candump_line(unmarked), encode_candump_line(theirs.records[i]));
  }
}

TEST_F(CanUtils, CanplayerPlaysOurLogAndAReplayGivesTheSame) {
  std::vector<CandumpRecord> recorded;
  {
    SocketCanBus bus = running_bus();
    CanNode node(name_);
    converse(bus, node, path("ours.log"));
    recorded = read(path("ours.log")).records;
  }
  CanNode listener(name_);
  EXPECT_EQ(Process({"canplayer", "-t", "-I", path("ours.log")}).wait(), 0);
  const auto played = listener.hear(recorded.size());
  ASSERT_EQ(played.size(), recorded.size());
  for (std::size_t i = 0; i < played.size(); ++i) EXPECT_EQ(played[i].can_id & CAN_EFF_MASK, recorded[i].frame.id) << i;

  SteppedClock clock;
  ReplayBus replay(recorded, clock, clock.now());
  clock.advance(60s);
  std::size_t answers = 0;
  while (auto received = replay.receive()) EXPECT_EQ(received->frame.data[1], answers++);
  EXPECT_EQ(answers, 50U);
  EXPECT_EQ(replay.transmitted().size(), 52U);
}

}  // namespace
