#include "hw/canopen/sdo.hpp"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <span>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/little_endian.hpp"

namespace hogline::hw {
namespace {

CanFrame request(std::uint8_t node, std::uint8_t command, ObjectAddress address, std::uint32_t value) {
  CanFrame frame{.id = sdo_request_cob_id(node), .length = 8, .data = {command}};
  put_le(std::span{frame.data}.subspan(1), address.index);
  frame.data[3] = address.sub;
  put_le(std::span{frame.data}.subspan(4), value);
  return frame;
}

ObjectAddress address_of(const CanFrame& frame) {
  return {get_le<std::uint16_t>(std::span{frame.data}.subspan(1)), frame.data[3]};
}

SdoResponse decode_initiate_upload(const CanFrame& frame) {
  const std::uint8_t command = frame.data[0];
  const bool expedited = (command & 0x02) != 0;
  const bool size_indicated = (command & 0x01) != 0;
  if (!expedited) {
    SdoSegmentedStart start{.address = address_of(frame), .size = std::nullopt};
    if (size_indicated) start.size = get_le<std::uint32_t>(std::span{frame.data}.subspan(4));
    return start;
  }
  const int unused = size_indicated ? (command >> 2) & 0x03 : 0;
  SdoExpedited value{.address = address_of(frame), .size = static_cast<std::uint8_t>(4 - unused)};
  std::copy_n(frame.data.begin() + 4, value.size, value.data.begin());
  return value;
}

SdoResponse decode_segment(const CanFrame& frame) {
  const std::uint8_t command = frame.data[0];
  SdoSegment segment{.toggle = (command & 0x10) != 0,
                     .last = (command & 0x01) != 0,
                     .size = static_cast<std::uint8_t>(7 - ((command >> 1) & 0x07))};
  std::copy_n(frame.data.begin() + 1, segment.size, segment.data.begin());
  return segment;
}

}  // namespace

std::string to_string(ObjectAddress address) {
  char text[8];
  std::snprintf(text, sizeof text, "%04X:%02X", unsigned{address.index}, unsigned{address.sub});
  return text;
}

CanFrame sdo_download_frame(std::uint8_t node, const SdoWrite& write) {
  assert(write.size >= 1 && write.size <= 4);
  const auto command = static_cast<std::uint8_t>(0x23 | ((4 - write.size) << 2));
  const std::uint32_t mask = write.size == 4 ? 0xFFFFFFFFu : (1u << (8 * write.size)) - 1u;
  return request(node, command, write.address, write.value & mask);
}

CanFrame sdo_upload_frame(std::uint8_t node, ObjectAddress address) { return request(node, 0x40, address, 0); }

CanFrame sdo_upload_segment_frame(std::uint8_t node, bool toggle) {
  return {.id = sdo_request_cob_id(node), .length = 8, .data = {static_cast<std::uint8_t>(toggle ? 0x70 : 0x60)}};
}

CanFrame sdo_abort_frame(std::uint8_t node, ObjectAddress address, std::uint32_t code) {
  return request(node, 0x80, address, code);
}

SdoResponse decode_sdo_response(const CanFrame& frame) {
  if (!is_canopen_frame(frame) || frame.length != 8) return SdoMalformed{};
  switch (frame.data[0] >> 5) {
    case 0:
      return decode_segment(frame);
    case 2:
      return decode_initiate_upload(frame);
    case 3:
      return SdoDownloadConfirmed{address_of(frame)};
    case 4:
      return SdoAborted{address_of(frame), get_le<std::uint32_t>(std::span{frame.data}.subspan(4))};
    default:
      return SdoMalformed{};
  }
}

const char* sdo_abort_meaning(std::uint32_t code) {
  switch (code) {
    case 0x05030000:
      return "toggle bit not alternated";
    case 0x05040000:
      return "SDO protocol timed out";
    case 0x05040001:
      return "command specifier not valid or unknown";
    case 0x05040005:
      return "out of memory";
    case 0x06010000:
      return "unsupported access to an object";
    case 0x06010001:
      return "attempt to read a write-only object";
    case 0x06010002:
      return "attempt to write a read-only object";
    case 0x06020000:
      return "object does not exist";
    case 0x06040041:
      return "object can not be mapped to the PDO";
    case 0x06040042:
      return "mapped objects would exceed the PDO's length";
    case 0x06040043:
      return "general parameter incompatibility";
    case 0x06040047:
      return "general internal incompatibility";
    case 0x06060000:
      return "access failed due to a hardware error";
    case 0x06070010:
      return "length of the parameter does not match";
    case 0x06070012:
      return "parameter too long";
    case 0x06070013:
      return "parameter too short";
    case 0x06090011:
      return "sub-index does not exist";
    case 0x06090030:
      return "invalid value for the parameter";
    case 0x06090031:
      return "value too high";
    case 0x06090032:
      return "value too low";
    case 0x08000000:
      return "general error";
    case 0x08000020:
      return "data can not be stored";
    case 0x08000021:
      return "data can not be stored because of local control";
    case 0x08000022:
      return "data can not be stored in the present device state";
    default:
      return "unlisted abort code";
  }
}

}  // namespace hogline::hw
