// What a JPEG decoder passes over in silence.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace hogline::hw::files {

/// Reads a JPEG's codes to their end without making a picture of them. What is wrong, in the decoder's words, where it
/// would have guessed or given up; else nothing. Damage after which the codes still make sense can not be told.
std::optional<std::string> jpeg_damage(std::span<const std::uint8_t> bytes);

}  // namespace hogline::hw::files
