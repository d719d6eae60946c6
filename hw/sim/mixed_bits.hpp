// Random numbers that belong to a place in a sequence rather than to the order in which they are drawn.
#pragma once

#include <cstdint>

namespace hogline::hw::sim {

/// splitmix64's finaliser (Steele, Lea, Flood 2014): neighbouring numbers give unrelated bits.
constexpr std::uint64_t mixed_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27U)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31U);
}

/// A number in (0, 1) from 64 random bits.
constexpr double uniform_of(std::uint64_t bits) { return (static_cast<double>(bits >> 11U) + 0.5) * 0x1.0p-53; }

}  // namespace hogline::hw::sim
