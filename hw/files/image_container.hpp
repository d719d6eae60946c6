// Whether the bytes of a picture's file are all there. Decoders fill up what is missing with grey and say nothing.
#pragma once

#include <cstdint>
#include <span>

namespace hogline::hw::files {

enum class Container { unknown, jpeg, png };

/// By the first bytes, whatever the file's name says.
Container container_of(std::span<const std::uint8_t> bytes);

/// A JPEG has its end-of-image marker after the scan's start (ITU-T T.81, B.2), a PNG its IEND chunk (ISO 15948, 5.6).
/// Precondition: the container is known.
bool is_complete(std::span<const std::uint8_t> bytes);

}  // namespace hogline::hw::files
