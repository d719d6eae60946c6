// CANopen's byte order (CiA 301, 7.1: least significant byte first), for integers up to four bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace hogline::hw {

/// Writes the value's bytes at the front of `out`. Precondition: out.size() >= sizeof(T).
template <std::integral T>
constexpr void put_le(std::span<std::uint8_t> out, T value) {
  auto rest = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<T>>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i, rest >>= 8) out[i] = static_cast<std::uint8_t>(rest & 0xFF);
}

/// Reads a value from the front of `in`. Precondition: in.size() >= sizeof(T).
template <std::integral T>
constexpr T get_le(std::span<const std::uint8_t> in) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value |= static_cast<std::uint64_t>(in[i]) << (8 * i);
  return static_cast<T>(static_cast<std::make_unsigned_t<T>>(value));
}

}  // namespace hogline::hw
