// The simulated jaws, written from the Robotiq 2F map in doc/modbus.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>

#include "hw/sim/scenario.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Moves only with the time handed to step(). A request is taken to arrive at the time of the last step.
class JawsDevice {
 public:
  static constexpr int unit = 9;
  static constexpr int holding_start = 0x03E8;
  static constexpr int input_start = 0x07D0;

  JawsDevice(const GripperScenario& scenario, std::uint64_t seed, Stamp start);

  /// A write of holding registers. Returns the exception code of the answer, 0 for none.
  int write(int address, std::span<const std::uint16_t> values);
  std::array<std::uint16_t, 3> inputs() const;
  void step(Stamp now);

  /// Whether a stone stands where closing fingers meet it.
  void stone_between(bool between) { between_ = between; }
  bool stone_in_jaws() const { return stone_; }
  /// When the stone became, or will become, free; empty while nothing opens.
  std::optional<Stamp> free_at() const { return free_at_; }

  void jam(bool jammed) { jammed_ = jammed; }  ///< fault injection: orders are answered, the fingers do not move
  void set_fault(std::uint8_t code) { fault_ = code; }  ///< fault injection
  void lose_stone();                                    ///< fault injection: closed jaws slip off the stone
  void give_way();                                      ///< fault injection: the fingers open, nobody having asked
  void cut_power();                                     ///< fault injection: activation is gone, the jaws stay put
  void place_stone() { stone_ = true; }                 ///< between open jaws

 private:
  enum class Activation { reset = 0, activating = 1, active = 3 };
  enum class Object { moving = 0, contact_closing = 2, at_position = 3 };

  void start_activation();
  void go_to(std::uint8_t position);
  void finish_motion();
  bool closing() const { return target_ > from_; }

  GripperScenario scenario_;
  std::mt19937_64 random_;
  Stamp now_;
  Activation activation_ = Activation::reset;
  Object object_ = Object::at_position;
  bool go_to_ = false;
  bool stone_ = false;
  bool between_ = false;
  bool catches_ = false;  ///< the present closing began with a stone between the fingers
  bool in_motion_ = false;
  bool jammed_ = false;
  std::uint8_t fault_ = 0;
  std::uint8_t requested_ = 0;
  double position_ = 0.0;
  double from_ = 0.0;
  double target_ = 0.0;
  double rate_per_s_ = 0.0;
  Stamp motion_start_;
  Stamp activation_end_;
  std::optional<Stamp> free_at_;
};

}  // namespace hogline::hw::sim
