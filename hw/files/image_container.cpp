#include "hw/files/image_container.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace hogline::hw::files {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 3> jpeg_start{0xFF, 0xD8, 0xFF};
constexpr std::array<std::uint8_t, 8> png_start{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

template <std::size_t N>
bool starts_with(Bytes bytes, const std::array<std::uint8_t, N>& start) {
  return bytes.size() >= N && std::equal(start.begin(), start.end(), bytes.begin());
}

// Segments before the scan carry their length, and may hold a whole thumbnail with markers of its own: step over them.
bool jpeg_is_complete(Bytes bytes) {
  constexpr std::uint8_t start_of_scan = 0xDA;
  constexpr std::uint8_t end_of_image = 0xD9;
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (bytes[at] != 0xFF) return false;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    const std::size_t length = 256U * bytes[at + 2] + bytes[at + 3];
    at += 2 + length;
    if (marker == start_of_scan) break;
  }
  for (; at + 1 < bytes.size(); ++at) {
    if (bytes[at] == 0xFF && bytes[at + 1] == end_of_image) return true;
  }
  return false;
}

bool png_is_complete(Bytes bytes) {
  std::size_t at = png_start.size();
  while (at + 12 <= bytes.size()) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = 256U * length + bytes[at + i];
    const bool end = bytes[at + 4] == 'I' && bytes[at + 5] == 'E' && bytes[at + 6] == 'N' && bytes[at + 7] == 'D';
    if (length > bytes.size()) return false;
    at += 12 + length;
    if (end) return at <= bytes.size();
  }
  return false;
}

}  // namespace

Container container_of(Bytes bytes) {
  if (starts_with(bytes, jpeg_start)) return Container::jpeg;
  if (starts_with(bytes, png_start)) return Container::png;
  return Container::unknown;
}

bool is_complete(Bytes bytes) {
  assert(container_of(bytes) != Container::unknown);
  return container_of(bytes) == Container::jpeg ? jpeg_is_complete(bytes) : png_is_complete(bytes);
}

}  // namespace hogline::hw::files
