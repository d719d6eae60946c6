// CANopen: any frames into the decoders of SDO, EMCY, heartbeat and PDOs, and into an SDO transfer under way.
#include <algorithm>
#include <string>

#include "hw/canopen/cia402.hpp"
#include "hw/canopen/drive_pdos.hpp"
#include "hw/canopen/emergency.hpp"
#include "hw/canopen/nmt.hpp"
#include "hw/canopen/sdo_client.hpp"
#include "tests/fuzz/require.hpp"

namespace hogline::fuzz {
namespace {

constexpr std::size_t frame_size = 11;  // identifier and flags, length, eight bytes of data
constexpr std::uint8_t node = 5;

hw::CanFrame frame_of(const std::uint8_t* bytes) {
  hw::CanFrame frame;
  frame.id = (static_cast<std::uint32_t>(bytes[0]) << 8U | bytes[1]) & 0x7FFU;
  frame.extended = (bytes[0] & 0x80U) != 0;
  frame.remote = (bytes[0] & 0x40U) != 0;
  frame.length = bytes[2] % 9;
  std::copy_n(bytes + 3, 8, frame.data.begin());
  return frame;
}

void decode(const hw::CanFrame& frame) {
  const auto response = hw::decode_sdo_response(frame);
  if (const auto* value = std::get_if<hw::SdoExpedited>(&response)) {
    require(value->size >= 1 && value->size <= 4, "an expedited value has 1..4 bytes");
  }
  if (const auto* segment = std::get_if<hw::SdoSegment>(&response)) {
    require(segment->size <= 7, "a segment has at most 7 bytes");
  }
  if (const auto* aborted = std::get_if<hw::SdoAborted>(&response)) {
    require(*hw::sdo_abort_meaning(aborted->code) != '\0', "an abort has words");
  }
  if (const auto emergency = hw::decode_emergency(frame)) {
    require(emergency->node >= 1 && emergency->node <= 127, "an emergency's node is 1..127");
    require(!hw::describe(*emergency).empty(), "an emergency has words");
  }
  if (const auto heartbeat = hw::decode_heartbeat(frame)) {
    require(heartbeat->node >= 1 && heartbeat->node <= 127, "a heartbeat's node is 1..127");
    require(*hw::to_string(heartbeat->state) != '\0', "a state has a name");
  }
  if (const auto status = hw::decode_status(frame)) {
    require(*hw::to_string(hw::decode_statusword(status->statusword)) != '\0', "a drive state has a name");
  }
  static_cast<void>(hw::decode_position(frame));
}

void take_all(hw::SdoClient& client) {
  while (const auto frame = client.take_frame()) {
    require(frame->id == 0x600U + node && frame->length == 8, "a request is eight bytes on 600+node");
  }
  if (const auto result = client.take_result()) {
    require(!result->describe().empty(), "a result has words");
    require(!client.busy(), "a result ends the transfer");
  }
}

// One transfer after the other; each frame is an answer, 10 ms after the one before.
void transfer(const std::uint8_t* bytes, std::size_t size) {
  hw::SdoClient client(node, std::chrono::milliseconds(100));
  Stamp now{std::chrono::seconds(1)};
  for (; size >= frame_size; bytes += frame_size, size -= frame_size) {
    now += std::chrono::milliseconds(10);
    if (!client.busy()) {
      const hw::ObjectAddress address{0x1008, 0};
      if ((bytes[0] & 0x20U) != 0) {
        client.start_download({.address = {0x6060, 0}, .value = 9, .size = 1}, now);
      } else {
        client.start_upload(address, now);
      }
    }
    take_all(client);
    client.on_frame(frame_of(bytes), now);
    client.step(now);
    take_all(client);
  }
  client.step(now + std::chrono::seconds(1));
  require(!client.busy(), "no transfer outlasts its timeout");
}

}  // namespace
}  // namespace hogline::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (std::size_t at = 0; at + hogline::fuzz::frame_size <= size; at += hogline::fuzz::frame_size) {
    hogline::fuzz::decode(hogline::fuzz::frame_of(data + at));
  }
  hogline::fuzz::transfer(data, size);
  return 0;
}
