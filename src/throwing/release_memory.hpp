// The file in which what releases have taught is kept from throw to throw.
#pragma once

#include <optional>
#include <string>

#include "servo/release_learning.hpp"

namespace hogline {

/// Nothing when there is no such file yet. A file that can not be read, lacks a key, has one too many, or holds a
/// number out of its range throws ConfigError: what a robot relies on is not guessed.
std::optional<servo::ReleaseKnowledge> load_release_knowledge(const std::string& path);

/// Written beside and renamed: the file is the old or the new one, never half of it. Throws std::runtime_error.
void save_release_knowledge(const std::string& path, const servo::ReleaseKnowledge& knowledge);

}  // namespace hogline
