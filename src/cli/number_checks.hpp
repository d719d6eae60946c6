// Checks of numbers on the command line that CLI11's own let pass.
#pragma once

#include <functional>
#include <string>

namespace hogline::cli {

/// Digits alone, for CLI11 would wrap -1 around. Empty: fine.
std::string whole_number(const std::string& text);

/// A finite number: what is allowed of it stands in a rig file.
std::string any_number(const std::string& text);

/// A finite number in this range: CLI11's Range takes NaN for one. The check gives an empty text: fine.
std::function<std::string(std::string&)> between(double low, double high);

/// A whole number in this range. The check gives an empty text: fine.
std::function<std::string(std::string&)> whole_between(int low, int high);

}  // namespace hogline::cli
