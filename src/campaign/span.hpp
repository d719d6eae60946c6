// A number, or anything between two.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hogline::campaign {

struct Span {
  double low = 0.0;
  double high = 0.0;

  /// The place of `share`, 0..1, between the ends.
  double at(double share) const { return low + (high - low) * share; }
};

/// "2.09" or "1.9..2.8"; nothing when it is not of that form, not finite, or the ends are the wrong way round.
std::optional<Span> parse_span(std::string_view text);

/// The same words again.
std::string to_string(const Span& span);

}  // namespace hogline::campaign
