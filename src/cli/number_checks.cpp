#include "src/cli/number_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace hogline::cli {

std::string whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : "'" + text + "' is no whole number from 0 to 999999999999999999";
}

namespace {

std::optional<double> finite_number(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool read = error == std::errc{} && end == text.data() + text.size();
  return read && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

std::string any_number(const std::string& text) {
  return finite_number(text) ? std::string() : "'" + text + "' is no number";
}

std::function<std::string(std::string&)> between(double low, double high) {
  return [low, high](std::string& text) {
    const auto number = finite_number(text);
    if (number && *number >= low && *number <= high) return std::string();
    return fmt::format("'{}' is no number from {} to {}", text, low, high);
  };
}

std::function<std::string(std::string&)> whole_between(int low, int high) {
  return [low, high](std::string& text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool read = error == std::errc{} && end == text.data() + text.size();
    if (read && number >= low && number <= high) return std::string();
    return fmt::format("'{}' is no whole number from {} to {}", text, low, high);
  };
}

}  // namespace hogline::cli
