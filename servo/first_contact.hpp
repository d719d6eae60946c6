// Whether and where a running stone first touches one that stands.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "servo/place.hpp"
#include "servo/stone_path.hpp"

namespace hogline::servo {

struct Contact {
  std::size_t stone = 0;  ///< which of those that stand
  double after_s = 0.0;
  SlidingStone striker;  ///< as it touches
};

/// The first touch from the path's start on; nothing when it comes to rest without one. A touch is found when the
/// stones would overlap by a hundredth of a millimetre. Preconditions: all finite.
std::optional<Contact> first_contact(const StonePath& path, std::span<const Place> standing);

}  // namespace hogline::servo
