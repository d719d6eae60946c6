// The object dictionary of a simulated CANopen device (CiA 301, 7.4): values, access rights, abort codes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace hogline::hw::sim {

enum class ObjectAccess { constant, read_only, write_only, read_write };

/// One sub-object. Numbers are stored least significant byte first, as on the wire.
struct ObjectEntry {
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint8_t> default_bytes;
  ObjectAccess access = ObjectAccess::read_only;
  bool mappable = false;
  bool variable_length = false;  ///< strings
  /// Asked before a write over SDO or PDO; 0 allows it, anything else is the abort code.
  std::function<std::uint32_t(std::int64_t value)> guard;
};

class ObjectDictionary {
 public:
  /// Adds a number of 1, 2 or 4 bytes. The returned entry may be given a guard.
  ObjectEntry& add(std::uint16_t index, std::uint8_t sub, int size, ObjectAccess access, std::int64_t value = 0,
                   bool mappable = false);
  void add_string(std::uint16_t index, std::uint8_t sub, std::string_view text);

  const ObjectEntry* find(std::uint16_t index, std::uint8_t sub) const;
  bool has_index(std::uint16_t index) const;

  // The device's own access: no rights, no guards. Precondition: the object exists.
  std::uint32_t get(std::uint16_t index, std::uint8_t sub = 0) const;
  std::int32_t get_signed(std::uint16_t index, std::uint8_t sub = 0) const;
  void set(std::uint16_t index, std::uint8_t sub, std::int64_t value);

  // Access from the bus: 0, or the abort code of the standard.
  std::uint32_t read(std::uint16_t index, std::uint8_t sub, std::vector<std::uint8_t>& out) const;
  std::uint32_t write(std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes);

  /// Back to the values of power-up, for indices first..last.
  void restore_defaults(std::uint16_t first, std::uint16_t last);

 private:
  static std::uint32_t key(std::uint16_t index, std::uint8_t sub) { return (std::uint32_t{index} << 8) | sub; }
  std::uint32_t missing(std::uint16_t index) const;

  std::map<std::uint32_t, ObjectEntry> entries_;
};

}  // namespace hogline::hw::sim
