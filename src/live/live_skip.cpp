#include "src/live/live_skip.hpp"

#include <fmt/format.h>

#include <utility>

#include "servo/ice_model.hpp"
#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

/// What the thread that looks has seen, as a seer.
class DoneLooks final : public SkipSeer {
 public:
  explicit DoneLooks(SkipSeer& done) : done_(done) {}
  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override {
    return done_.near_view(frame, q, known);
  }
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override {
    return done_.far_view(frame, q, known);
  }

 private:
  SkipSeer& done_;
};

const char* word(OrderPhase phase) {
  constexpr const char* words[] = {"none", "sent", "throwing", "released", "refused"};
  return words[static_cast<std::size_t>(phase)];
}

const char* fate(servo::StoneFate fate) {
  constexpr const char* words[] = {"the stone lies at", "the stone lies short of the hog line, at",
                                   "the stone touched a sideline, at", "the stone went through, at",
                                   "the stone was last seen at"};
  return words[static_cast<std::size_t>(fate)];
}

std::string words_of(const servo::SkipReport& report) {
  std::string words = report.ok ? std::string() : report.reason;
  for (const servo::StoneOutcome& stone : report.result.stones) {
    if (!stone.thrown) continue;
    if (!words.empty()) words += "; ";
    return words + fmt::format("{} {:.3f}, {:.3f} m", fate(stone.fate), stone.x_m, stone.y_m);
  }
  return words.empty() ? "no stone came" : words;
}

}  // namespace

LiveSkip::LiveSkip(const config::SkipRig& rig, SteelSkip& robot, hw::TeamLink& link, const hw::Clock& clock,
                   const MakeSeer& make_seer, Tell tell)
    : tell_(std::move(tell)),
      robot_(robot),
      eyes_(make_seer, robot.near_camera(), robot.far_camera(), clock),
      member_(
          rig, SkipDevices{robot.head(), eyes_.near_camera(), eyes_.far_camera()},
          [this] { return std::make_unique<DoneLooks>(eyes_.seer()); }, link),
      ice_(servo::IceModel(servo::IceModelConfig{}).estimate()) {}

void LiveSkip::step(Stamp now, Duration dt) {
  member_.step(now, dt);
  eyes_.note(robot_.head().state(), member_.loop() ? member_.skip().diagnosis() : servo::SkipDiagnosis{});
  watch();
  const std::string missing = member_.missing(now);
  const bool there = missing.empty();
  if (told_there_ != there) tell_(there ? "heard" : "silent", there ? "thrower" : missing);
  told_there_ = there;
}

std::string LiveSkip::begin(Stamp now) { return begin(ice_, now); }

std::string LiveSkip::begin(const servo::IceEstimate& ice, Stamp now) {
  if (member_.order_is_open() && member_.missing(now).empty()) return "a shot is under way: it is followed to its end";
  told_state_.reset();
  told_order_ = OrderPhase::none;
  eyes_.forget();
  member_.begin(ice, now);
  return {};
}

SkipView LiveSkip::view(Stamp now) const {
  SkipView view{.waits = member_.waits(),
                .has_looked = member_.has_looked(),
                .over = member_.over(),
                .thrower_armed = member_.thrower_armed(now),
                .ordered = member_.ordered(),
                .why = member_.why(),
                .standing = {},
                .sheet_width_m = {},
                .report = {}};
  if (!member_.loop()) return view;
  view.standing = member_.skip().diagnosis().standing;
  view.sheet_width_m = member_.skip().diagnosis().sheet_width_m;
  if (view.over) view.report = member_.skip().report();
  return view;
}

std::string LiveSkip::order(const servo::ShotOrder& shot, std::uint32_t number, Team team, Stamp now) {
  if (!member_.waits()) return "the skip has not looked, or is not ready for a stone: begin";
  if (const std::string missing = member_.missing(now); !missing.empty()) return missing;
  if (member_.ordered() != OrderPhase::none && member_.ordered() != OrderPhase::refused) return "a shot is under way";
  member_.order(shot, number, team, now);
  return {};
}

void LiveSkip::watch() {
  const auto error = robot_.head().state().error;
  const std::string words = error ? error->device + ": " + error->what : std::string();
  if (told_error_ != words && !words.empty()) tell_("device error", words);
  told_error_ = words;
  if (!member_.loop()) return;
  if (told_state_ != member_.skip().state()) {
    told_state_ = member_.skip().state();
    tell_("state", servo::to_string(*told_state_));
    if (*told_state_ == servo::SkipState::aim) {
      tell_("board", fmt::format("{} stones", member_.skip().diagnosis().standing.size()));
    }
    if (member_.over()) {
      for (const std::string& remark : member_.skip().report().remarks) tell_("remark", remark);
    }
    if (member_.over()) tell_(member_.skip().report().ok ? "outcome" : "stopped", words_of(member_.skip().report()));
  }
  if (told_order_ != member_.ordered()) {
    told_order_ = member_.ordered();
    tell_("order",
          std::string(word(told_order_)) + (told_order_ == OrderPhase::refused ? ": " + member_.why() : std::string()));
  }
}

}  // namespace hogline
