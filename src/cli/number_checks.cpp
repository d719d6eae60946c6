#include "src/cli/number_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace hogline::cli {

std::string whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : "'" + text + "' is no whole number from 0 to 999999999999999999";
}

std::function<std::string(std::string&)> between(double low, double high) {
  return [low, high](std::string& text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool read = error == std::errc{} && end == text.data() + text.size();
    if (read && std::isfinite(number) && number >= low && number <= high) return std::string();
    return fmt::format("'{}' is no number from {} to {}", text, low, high);
  };
}

}  // namespace hogline::cli
