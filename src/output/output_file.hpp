// Where a command's results go: checked before the work, written whole.
#pragma once

#include <string>

namespace hogline {

/// Makes the folder that `option` names. Throws ConfigError where nothing can be written into it.
void check_folder(const std::string& option, const std::string& folder);

/// Throws ConfigError where the file that `option` names can not be written: it is a folder, or in none.
void check_file(const std::string& option, const std::string& path);

/// Throws std::runtime_error.
void write_text(const std::string& path, const std::string& text);

/// Under another name first: whatever happens, what stands under its own name is whole. Throws std::runtime_error.
void replace_text(const std::string& path, const std::string& text);

}  // namespace hogline
