#include "hw/sim/object_dictionary.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::hw::sim {
namespace {

std::vector<std::uint8_t> to_bytes(std::int64_t value, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF);
  return bytes;
}

std::uint32_t to_number(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = std::min<std::size_t>(bytes.size(), 4); i-- > 0;) value = (value << 8) | bytes[i];
  return value;
}

std::int32_t to_signed(std::span<const std::uint8_t> bytes) {
  switch (bytes.size()) {
    case 1:
      return static_cast<std::int8_t>(bytes[0]);
    case 2:
      return static_cast<std::int16_t>(to_number(bytes));
    default:
      return static_cast<std::int32_t>(to_number(bytes));
  }
}

}  // namespace

ObjectEntry& ObjectDictionary::add(std::uint16_t index, std::uint8_t sub, int size, ObjectAccess access,
                                   std::int64_t value, bool mappable) {
  assert(size == 1 || size == 2 || size == 4);
  ObjectEntry& entry = entries_[key(index, sub)];
  entry.bytes = to_bytes(value, static_cast<std::size_t>(size));
  entry.default_bytes = entry.bytes;
  entry.access = access;
  entry.mappable = mappable;
  return entry;
}

void ObjectDictionary::add_string(std::uint16_t index, std::uint8_t sub, std::string_view text) {
  ObjectEntry& entry = entries_[key(index, sub)];
  entry.bytes.assign(text.begin(), text.end());
  entry.default_bytes = entry.bytes;
  entry.access = ObjectAccess::constant;
  entry.variable_length = true;
}

const ObjectEntry* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) const {
  const auto found = entries_.find(key(index, sub));
  return found == entries_.end() ? nullptr : &found->second;
}

bool ObjectDictionary::has_index(std::uint16_t index) const {
  const auto found = entries_.lower_bound(key(index, 0));
  return found != entries_.end() && (found->first >> 8) == index;
}

std::uint32_t ObjectDictionary::get(std::uint16_t index, std::uint8_t sub) const {
  return to_number(entries_.at(key(index, sub)).bytes);
}

std::int32_t ObjectDictionary::get_signed(std::uint16_t index, std::uint8_t sub) const {
  return to_signed(entries_.at(key(index, sub)).bytes);
}

void ObjectDictionary::set(std::uint16_t index, std::uint8_t sub, std::int64_t value) {
  ObjectEntry& entry = entries_.at(key(index, sub));
  entry.bytes = to_bytes(value, entry.bytes.size());
}

std::uint32_t ObjectDictionary::missing(std::uint16_t index) const {
  return has_index(index) ? 0x06090011 : 0x06020000;  // no such sub-index, no such object
}

std::uint32_t ObjectDictionary::read(std::uint16_t index, std::uint8_t sub, std::vector<std::uint8_t>& out) const {
  const ObjectEntry* entry = find(index, sub);
  if (!entry) return missing(index);
  if (entry->access == ObjectAccess::write_only) return 0x06010001;
  out = entry->bytes;
  return 0;
}

std::uint32_t ObjectDictionary::write(std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes) {
  const auto found = entries_.find(key(index, sub));
  if (found == entries_.end()) return missing(index);
  ObjectEntry& entry = found->second;
  if (entry.access == ObjectAccess::constant || entry.access == ObjectAccess::read_only) return 0x06010002;
  if (bytes.size() != entry.bytes.size() && !entry.variable_length) return 0x06070010;
  if (entry.guard) {
    const std::uint32_t abort_code = entry.guard(to_signed(bytes));
    if (abort_code != 0) return abort_code;
  }
  entry.bytes.assign(bytes.begin(), bytes.end());
  return 0;
}

void ObjectDictionary::restore_defaults(std::uint16_t first, std::uint16_t last) {
  for (auto& [where, entry] : entries_) {
    if ((where >> 8) >= first && (where >> 8) <= last) entry.bytes = entry.default_bytes;
  }
}

}  // namespace hogline::hw::sim
