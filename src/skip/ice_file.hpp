// The file in which what is known of a sheet's ice is kept from throw to throw: YAML, versioned, checked.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "servo/throw_fit.hpp"

namespace hogline {

/// Nothing when there is no such file yet. A file that can not be read, lacks a key, has one too many, is of another
/// version, or holds what can be no ice throws ConfigError: what a shot relies on is not guessed.
std::optional<servo::IceEstimate> load_ice(const std::string& path);
servo::IceEstimate parse_ice(std::string_view text, const std::string& name);

/// As the file's text: the same numbers again, to the last digit.
std::string ice_text(const servo::IceEstimate& ice);
/// Written beside and renamed: the file is the old or the new one, never half of it. Throws std::runtime_error.
void save_ice(const std::string& path, const servo::IceEstimate& ice);

}  // namespace hogline
