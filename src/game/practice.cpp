#include "src/game/practice.hpp"

#include <utility>

#include "servo/game/board.hpp"
#include "servo/shot_aiming.hpp"

namespace hogline::game {
namespace {

constexpr servo::Place tee{0.0, servo::in_sheet::tee_y_m};

}  // namespace

Practice::Practice(int draws, const servo::ThrowerSkill& skill, std::function<servo::IceModel()> ice,
                   const std::array<hw::Strategist*, servo::team_count>& strategists, StoneThrower& thrower, Told told)
    : draws_(draws),
      skill_(skill),
      ice_(std::move(ice)),
      strategists_(strategists),
      thrower_(thrower),
      told_(std::move(told)) {}

void Practice::step(Stamp now) {
  for (auto* strategist : strategists_) strategist->step(now);
  if (over()) return;
  if (!throwing_) return begin_draw(now);
  const auto report = thrower_.step(now);
  if (!report) return;
  throwing_ = false;
  if (told_) told_(thrown_, turn_, *report);
  ++thrown_;
  if (report->end != ThrowEnd::thrown) failure_ = "practice: the throw failed: " + report->reason;
}

// Either curl in turn: a floor that is not level looks like curl to one of them.
void Practice::begin_draw(Stamp now) {
  const servo::Curl curl = thrown_ % 2 == 0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise;
  const servo::ShotAim aim = aim_shot({tee, curl}, skill_, ice_());
  if (!aim.ok) {
    failure_ = "practice: no draw to the tee: " + aim.reason;
    return;
  }
  turn_ = {};
  turn_.team = servo::team_of(static_cast<std::size_t>(thrown_ % servo::team_count));
  turn_.decision.order = aim.order;
  turn_.decision.plan = "practice";
  thrower_.start(turn_, now);
  throwing_ = true;
}

}  // namespace hogline::game
