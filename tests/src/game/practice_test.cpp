// Draws before a game: what is learnt from them, and that strategists prepare meanwhile.
#include "src/game/practice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/game/built_in_strategist.hpp"
#include "tests/src/game/ice_table.hpp"

namespace hogline::game::test {
namespace {

/// A strategist that only counts how often it was given time.
class Counting final : public hw::Strategist {
 public:
  void begin(const std::array<std::string, servo::team_count>&, Stamp) override {}
  void tell(const servo::GameUpdate&, Stamp) override {}
  void step(Stamp) override { ++steps; }
  const hw::StrategistState& state() const override { return state_; }
  int steps = 0;

 private:
  hw::StrategistState state_;
};

struct PracticedSheet {
  PracticedSheet(std::uint64_t seed, int draws)
      : throws(any_sheet(seed), robot(), servo::IceModel({}), seed),
        practice(
            draws, robot(), [this] { return throws.ice(); }, {&one, &two}, throws,
            [this](int draw, const Turn& turn, const ThrowReport& report) {
              EXPECT_EQ(draw, static_cast<int>(turns.size()));
              EXPECT_EQ(report.end, ThrowEnd::thrown);
              turns.push_back(turn);
            }) {
    Stamp now{};
    while (!practice.over()) practice.step(now += 10ms);
  }
  double friction_error() const {
    return throws.ice().estimate().friction_scale / throws.sheet().ice.friction_scale - 1.0;
  }

  Counting one, two;
  SimulatedThrows throws;
  std::vector<Turn> turns;
  Practice practice;
};

TEST(Practice, AfterTwoDrawsTheFirstStoneOfTheGameIsForetoldAsLaterOnes) {
  double square = 0.0;
  constexpr int sheets = 20;
  for (std::uint64_t seed = 1; seed <= sheets; ++seed) {
    const PracticedSheet sheet(seed, 2);
    EXPECT_TRUE(sheet.practice.failure().empty());
    ASSERT_EQ(sheet.turns.size(), 2u);
    EXPECT_NE(sheet.turns[0].decision.order->curl, sheet.turns[1].decision.order->curl);
    square += std::pow(sheet.friction_error(), 2);
  }
  EXPECT_LT(std::sqrt(square / sheets), 0.006) << "1 % of friction is 0.28 m of a draw";
}

TEST(Practice, StrategistsAreGivenTimeMeanwhile) {
  const PracticedSheet sheet(1, 2);
  EXPECT_GE(sheet.one.steps, 4);
  EXPECT_EQ(sheet.one.steps, sheet.two.steps);
}

TEST(Practice, NoneIsOverAtOnce) {
  const PracticedSheet sheet(1, 0);
  EXPECT_TRUE(sheet.turns.empty());
  EXPECT_TRUE(sheet.practice.failure().empty());
}

/// Fails, or says that a draw can not be thrown.
class Failing final : public StoneThrower {
 public:
  void start(const Turn&, Stamp) override { ++started; }
  std::optional<ThrowReport> step(Stamp) override {
    ThrowReport report;
    report.reason = "a drive is silent";
    return report;
  }
  int started = 0;
};

TEST(Practice, ADrawThatFailsEndsIt) {
  Failing failing;
  Counting one, two;
  Practice practice(3, robot(), [] { return servo::IceModel({}); }, {&one, &two}, failing, {});
  Stamp now{};
  for (int i = 0; i < 10 && !practice.over(); ++i) practice.step(now += 10ms);
  EXPECT_EQ(failing.started, 1);
  EXPECT_EQ(practice.failure(), "practice: the throw failed: a drive is silent");
}

TEST(Practice, AThrowerThatIsTooWeakThrowsNothing) {
  Failing failing;
  Counting one, two;
  servo::ThrowerSkill weak = robot();
  weak.max_speed_mps = 1.0;
  Practice practice(1, weak, [] { return servo::IceModel({}); }, {&one, &two}, failing, {});
  practice.step(Stamp{});
  EXPECT_TRUE(practice.over());
  EXPECT_EQ(failing.started, 0);
  EXPECT_EQ(practice.failure(), "practice: no draw to the tee: the thrower is not fast enough");
}

}  // namespace
}  // namespace hogline::game::test
