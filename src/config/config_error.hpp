// The one way a configuration is refused: a line that names file, key, value and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace hogline::config {

struct ConfigError : std::runtime_error {
  /// "FILE:LINE: KEY = VALUE: PROBLEM"; line 0 and an empty value are left out.
  ConfigError(std::string file_name, int line_number, std::string key_path, std::string value_text,
              std::string problem);

  std::string file;
  int line;
  std::string key;      ///< "cameras.near.fx_px"; empty for the file as a whole
  std::string value;    ///< as it stands in the file, shortened
  std::string allowed;  ///< what is wrong, and what would be right
};

}  // namespace hogline::config
