#include "src/cli/commands.hpp"

namespace hogline::cli {

std::string whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : "'" + text + "' is no whole number from 0 to 999999999999999999";
}

}  // namespace hogline::cli
