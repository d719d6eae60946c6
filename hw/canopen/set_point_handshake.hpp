// The set-point handshake of profile position (CiA 402, 6060 = 1): controlword bits 4 to 6 against statusword bits 10
// and 12. No IO.
#pragma once

#include <cstdint>
#include <optional>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

// Controlword.
inline constexpr std::uint16_t new_set_point_bit = 1u << 4;
inline constexpr std::uint16_t change_immediately_bit = 1u << 5;  ///< a newer target does not wait for the older
// Statusword, in profile position.
inline constexpr std::uint16_t target_reached_bit = 1u << 10;
inline constexpr std::uint16_t set_point_acknowledge_bit = 1u << 12;
inline constexpr std::uint16_t following_error_bit = 1u << 13;

/// One target at a time:
///
///   phase    | bit 4 | goes on when           | to
///   idle     | 0     | a target was asked for | offered
///   offered  | 0     | bit 12 is 0            | raised: the target has been on the bus for one step at least
///   raised   | 1     | bit 12 is 1            | lowered
///   lowered  | 0     | bit 12 is 0            | idle, or offered if a newer target came meanwhile
///
/// The target on the bus changes only on the way into `offered`, so that the drive never takes half of a change.
class SetPointHandshake {
 public:
  enum class Phase { idle, offered, raised, lowered };

  /// The newest wins.
  void request(std::int32_t target) { requested_ = target; }
  /// Forgets everything: the drive was stopped, or is in another mode.
  void restart();

  /// The controlword bits for this step. Only while the drive is enabled and shows profile position.
  std::uint16_t step(std::uint16_t statusword, Stamp now);

  /// What 607A must hold in this step.
  std::int32_t target() const { return target_; }
  Phase phase() const { return phase_; }
  /// Everything asked for was acknowledged.
  bool settled() const { return phase_ == Phase::idle && !requested_; }
  /// The drive has not answered with bit 12 for longer than this.
  bool overdue(Stamp now, Duration deadline) const { return phase_ != Phase::idle && now - since_ > deadline; }

 private:
  void enter(Phase phase, Stamp now);

  Phase phase_ = Phase::idle;
  Stamp since_{};
  std::int32_t target_ = 0;
  std::optional<std::int32_t> requested_;
};

}  // namespace hogline::hw
