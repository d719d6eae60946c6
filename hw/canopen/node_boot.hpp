// Brings one drive's node from power-up to configured in pre-operational. Frames and time in, frames out, no IO.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/drive_setup.hpp"
#include "hw/canopen/sdo_client.hpp"
#include "hw/device_status.hpp"

namespace hogline::hw {

class NodeBoot {
 public:
  enum class Stage {
    idle,
    identify,             ///< reads 1000, 1018 and the device's name; asks again until the deadline
    reset_communication,  ///< waits for the boot-up message
    configure,            ///< writes the setup
    verify,               ///< reads all of it back: a drive that confirms a watchdog may still not have it
    confirm_mode,         ///< reads 6061 until it shows the mode
    done,
  };
  struct Failure {
    DeviceErrorKind kind = DeviceErrorKind::timeout;
    std::string what;
  };

  /// `setup` ends with 6061 showing `mode`. Precondition: all of a configuration that config_error() accepts.
  NodeBoot(NodeIdentity identity, const DriveTiming& timing, std::vector<SdoWrite> setup, std::int8_t mode);

  void start(Stamp now);
  /// Forgets everything that was still to be sent.
  void cancel();

  /// A frame on 580+node.
  void on_sdo(const CanFrame& frame, Stamp now) { sdo_.on_frame(frame, now); }
  /// The node's boot-up message. False if none is expected now: the node was reset by something else.
  bool on_boot_up(Stamp now);
  void step(Stamp now);
  std::optional<CanFrame> take_frame();

  Stage stage() const { return stage_; }
  bool done() const { return stage_ == Stage::done; }
  /// Why the boot ended early.
  const std::optional<Failure>& failure() const { return failure_; }
  /// Object 1008, empty if the device has none.
  const std::string& device_name() const { return device_name_; }

 private:
  void enter(Stage stage, Stamp now);
  void fail(DeviceErrorKind kind, std::string what);
  void fail(const SdoResult& result);
  void identify(Stamp now);
  bool accept_identity(ObjectAddress address, const SdoResult& result);
  std::uint32_t expected_identity(ObjectAddress address) const;
  void configure(Stamp now);
  void verify(Stamp now);
  bool accept_held(const SdoExpectation& expected, const SdoResult& result);
  void confirm_mode(Stamp now);
  void check_deadline(Stamp now);

  NodeIdentity identity_;
  Duration stage_timeout_;
  std::vector<SdoWrite> setup_;
  std::vector<SdoExpectation> expected_;
  std::int8_t mode_;

  Stage stage_ = Stage::idle;
  Stamp stage_since_{};
  std::size_t item_ = 0;  ///< of the stage's list
  SdoClient sdo_;
  std::deque<CanFrame> outgoing_;
  std::string device_name_;
  std::optional<Failure> failure_;
};

}  // namespace hogline::hw
