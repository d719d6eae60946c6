// What simulated spin belt and folding arm have in common, written from the axis map (version 1) in doc/modbus.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hw/sim/scenario.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Sequence, watchdog, faults and registers. Moves only with the time handed to step(); a request is taken to arrive at
/// the time of the last step.
class AxisDevice {
 public:
  static constexpr int holding_start = 0x0100;
  static constexpr int input_start = 0x0200;

  AxisDevice(std::uint16_t kind, double watchdog_s, Stamp start);
  virtual ~AxisDevice() = default;

  /// A write of holding registers. Returns the exception code of the answer, 0 for none.
  int write(int address, std::span<const std::uint16_t> values);
  std::array<std::uint16_t, 8> inputs() const;
  void step(Stamp now);

  void set_fault(std::uint16_t code);  ///< fault injection; 0 takes the cause away
  void power_cycle();                  ///< fault injection

 protected:
  enum class Verdict { carried_out, illegal_value };
  struct Readings {
    bool moving = false;
    bool at_target = false;
    bool folded = false;
    bool unfolded = false;
    std::int16_t actual = 0;
    std::uint16_t limit = 0;
  };

 private:
  virtual Verdict carry_out(std::uint16_t command, std::int16_t argument) = 0;
  virtual void halt() = 0;
  virtual void advance(double dt_s) = 0;
  virtual Readings readings() const = 0;

  int write_command(std::uint16_t sequence, std::uint16_t command, std::int16_t argument);
  bool fresh() const { return refreshed_ && now_ - refreshed_at_ <= watchdog_time_; }

  std::uint16_t kind_;
  Duration watchdog_time_;
  Stamp now_;
  Stamp refreshed_at_;
  bool refreshed_ = false;
  bool tripped_ = true;
  bool faulted_ = false;
  std::uint16_t fault_ = 0;
  std::uint16_t sequence_ = 0;
  std::uint16_t watchdog_ = 0;
};

/// Spins the stone; kind "B1".
class BeltDevice final : public AxisDevice {
 public:
  static constexpr int unit = 10;
  BeltDevice(const SpinBeltScenario& scenario, Stamp start);
  double speed_radps() const { return speed_radps_; }  ///< of a held stone

 private:
  Verdict carry_out(std::uint16_t command, std::int16_t argument) override;
  void halt() override { target_radps_ = 0.0; }
  void advance(double dt_s) override;
  Readings readings() const override;

  SpinBeltScenario scenario_;
  double target_radps_ = 0.0;
  double speed_radps_ = 0.0;
};

/// Folds the head down; kind "A1".
class ArmDevice final : public AxisDevice {
 public:
  static constexpr int unit = 11;
  ArmDevice(const ArmScenario& scenario, Stamp start);
  double unfolded() const { return place_; }  ///< 0 folded .. 1 unfolded

 private:
  Verdict carry_out(std::uint16_t command, std::int16_t argument) override;
  void halt() override { target_ = place_; }
  void advance(double dt_s) override;
  Readings readings() const override;

  ArmScenario scenario_;
  double place_ = 0.0;
  double target_ = 0.0;
};

}  // namespace hogline::hw::sim
