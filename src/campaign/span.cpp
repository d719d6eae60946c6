#include "src/campaign/span.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace hogline::campaign {
namespace {

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = !text.empty() && parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size();
  if (!whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<Span> parse_span(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) {
    const auto value = parse_number(text);
    if (!value) return std::nullopt;
    return Span{*value, *value};
  }
  const auto low = parse_number(text.substr(0, dots));
  const auto high = parse_number(text.substr(dots + 2));
  if (!low || !high || *low > *high) return std::nullopt;
  return Span{*low, *high};
}

std::string to_string(const Span& span) {
  return span.low == span.high ? fmt::format("{}", span.low) : fmt::format("{}..{}", span.low, span.high);
}

}  // namespace hogline::campaign
