// What somebody who mistyped a word may have meant.
#pragma once

#include <span>
#include <string>

namespace hogline::config {

/// The known word with the fewest letters to change, if those are at most half of the word's; else empty.
std::string nearest_word(const std::string& word, std::span<const std::string> known);

}  // namespace hogline::config
