// A skip that stays: a member of the team (SkipMember) whose looks go on in a thread of their own, and whose operator
// says when it looks and what is ordered.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "src/live/skip_eyes_thread.hpp"
#include "src/steel/steel_skip.hpp"
#include "src/team/skip_member.hpp"

namespace hogline {

/// What there is to know of a skip at a moment.
struct SkipView {
  bool waits = false;       ///< for a stone
  bool has_looked = false;  ///< at the house
  bool over = false;        ///< report is there
  bool thrower_armed = false;
  OrderPhase ordered = OrderPhase::none;
  std::string why;  ///< when refused
  std::vector<StoneSighting> standing;
  std::optional<double> sheet_width_m;
  servo::SkipReport report;
};

/// Used by one thread. Nothing of the head moves before begin(), nor after a fault before the next one.
class LiveSkip {
 public:
  using MakeSeer = std::function<std::unique_ptr<SkipSeer>()>;
  using Tell = std::function<void(const char* event, const std::string& what)>;

  /// Robot, link and clock must outlive it.
  LiveSkip(const config::SkipRig& rig, SteelSkip& robot, hw::TeamLink& link, const hw::Clock& clock,
           const MakeSeer& make_seer, Tell tell);

  /// One control period.
  void step(Stamp now, Duration dt);
  /// Clears latched errors, looks at the house and waits for a stone. Whatever was under way ends.
  /// `ice`: in s; without it what is known of any ice.
  /// Why not, as long as a shot is under way with a thrower that is there: somebody must follow it. Empty: it looks.
  std::string begin(Stamp now);
  std::string begin(const servo::IceEstimate& ice, Stamp now);
  /// Why not, where it can not be ordered now; empty: it is on its way. `number`: of the end's shots, from 1.
  std::string order(const servo::ShotOrder& shot, std::uint32_t number, Team team, Stamp now);
  SkipView view(Stamp now) const;

 private:
  void watch();

  Tell tell_;
  SteelSkip& robot_;
  SkipEyesThread eyes_;
  SkipMember member_;
  servo::IceEstimate ice_;
  std::optional<servo::SkipState> told_state_;
  OrderPhase told_order_ = OrderPhase::none;
  std::optional<bool> told_there_;
  std::optional<std::string> told_error_;
};

}  // namespace hogline
