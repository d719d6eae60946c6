// One SDO transfer at a time with one node, as a state machine: frames and time in, frames and a result out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/canopen/sdo.hpp"

namespace hogline::hw {

struct SdoResult {
  enum class Outcome {
    ok,
    aborted,   ///< by the server; abort_code says why
    timeout,   ///< no answer within the deadline
    protocol,  ///< an answer that does not belong to the request, or a wrong toggle bit or length
  };
  Outcome outcome = Outcome::ok;
  ObjectAddress address;
  std::uint32_t abort_code = 0;    ///< of the server, or the one the client sent
  std::vector<std::uint8_t> data;  ///< of an upload

  /// The data as an unsigned number; nothing unless 1..4 bytes came.
  std::optional<std::uint32_t> value() const;
  /// "SDO 6060:00: aborted 06010002, attempt to write a read-only object".
  std::string describe() const;
};

/// Use: start_*, then each step: on_frame() for every answer, step(now), send what take_frame() gives until it gives
/// nothing, and look at take_result().
class SdoClient {
 public:
  SdoClient(std::uint8_t node, Duration timeout) : node_(node), timeout_(timeout) {}

  // Precondition: not busy.
  void start_download(const SdoWrite& write, Stamp now);
  void start_upload(ObjectAddress address, Stamp now);

  bool busy() const { return phase_ != Phase::idle; }
  /// Forgets a transfer without a word to the server (the node was reset) and any result.
  void cancel();

  /// A frame received on 580+node. Without a transfer in progress it is ignored: a late answer.
  void on_frame(const CanFrame& frame, Stamp now);
  void step(Stamp now);

  std::optional<CanFrame> take_frame();
  std::optional<SdoResult> take_result();

 private:
  enum class Phase { idle, downloading, upload_started, upload_segments };

  void begin(Phase phase, ObjectAddress address, const CanFrame& frame, Stamp now);
  void finish(SdoResult::Outcome outcome, std::uint32_t abort_code = 0);
  void refuse(std::uint32_t abort_code);
  void on_expedited(const SdoExpedited& value);
  void on_segmented_start(const SdoSegmentedStart& start, Stamp now);
  void on_segment(const SdoSegment& segment, Stamp now);
  void request_segment(Stamp now);

  std::uint8_t node_;
  Duration timeout_;
  Phase phase_ = Phase::idle;
  ObjectAddress address_;
  Stamp deadline_{};
  bool toggle_ = false;
  std::optional<std::uint32_t> announced_size_;
  std::vector<std::uint8_t> data_;
  std::optional<CanFrame> outgoing_;
  std::optional<SdoResult> result_;
};

}  // namespace hogline::hw
