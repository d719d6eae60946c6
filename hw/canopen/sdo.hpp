// The client side of SDO (CiA 301, 7.2.4): expedited download and upload, segmented upload, aborts. Frames, no IO.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// The multiplexor: where in the object dictionary.
struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  bool operator==(const ObjectAddress&) const = default;
};

/// "6040:00".
std::string to_string(ObjectAddress address);

/// A value of 1..4 bytes to be written. `optional`: a device without the object is content with that.
struct SdoWrite {
  ObjectAddress address;
  std::uint32_t value = 0;  ///< two's complement for signed objects
  std::uint8_t size = 4;
  bool optional = false;
};

// What the client sends. Preconditions: node 1..127, size 1..4.
CanFrame sdo_download_frame(std::uint8_t node, const SdoWrite& write);
CanFrame sdo_upload_frame(std::uint8_t node, ObjectAddress address);
CanFrame sdo_upload_segment_frame(std::uint8_t node, bool toggle);
CanFrame sdo_abort_frame(std::uint8_t node, ObjectAddress address, std::uint32_t code);

// What the server answers.
struct SdoDownloadConfirmed {
  ObjectAddress address;
};
struct SdoExpedited {
  ObjectAddress address;
  std::uint8_t size = 0;  ///< 1..4; 4 where the server did not say
  std::array<std::uint8_t, 4> data{};
};
struct SdoSegmentedStart {
  ObjectAddress address;
  std::optional<std::uint32_t> size;  ///< in bytes, where the server said
};
struct SdoSegment {
  bool toggle = false;
  bool last = false;
  std::uint8_t size = 0;  ///< 0..7
  std::array<std::uint8_t, 7> data{};
};
struct SdoAborted {
  ObjectAddress address;
  std::uint32_t code = 0;
};
struct SdoMalformed {};  ///< not eight bytes, or a command specifier that no server may send here

using SdoResponse =
    std::variant<SdoMalformed, SdoDownloadConfirmed, SdoExpedited, SdoSegmentedStart, SdoSegment, SdoAborted>;

/// Decodes a frame on 580+node (the identifier is the caller's business).
SdoResponse decode_sdo_response(const CanFrame& frame);

// Abort codes the client itself sends or acts upon (table 22).
inline constexpr std::uint32_t sdo_abort_toggle = 0x05030000;
inline constexpr std::uint32_t sdo_abort_timeout = 0x05040000;
inline constexpr std::uint32_t sdo_abort_command = 0x05040001;
inline constexpr std::uint32_t sdo_abort_length = 0x06070010;
inline constexpr std::uint32_t sdo_abort_no_object = 0x06020000;
inline constexpr std::uint32_t sdo_abort_no_sub_index = 0x06090011;

/// The standard's words for an abort code; "unlisted abort code" for others.
const char* sdo_abort_meaning(std::uint32_t code);

}  // namespace hogline::hw
