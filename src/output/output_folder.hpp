// The folder that a command fills over time: one program's at a time.
#pragma once

#include <string>

namespace hogline {

/// Held as long as this lives. When the program ends, however it does, the folder is free.
class OutputFolder {
 public:
  /// Makes the folder that `option` names. Throws ConfigError where nothing can be written into it, or where another
  /// program is writing. A file system without locks is told of on stderr.
  OutputFolder(const std::string& option, const std::string& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace hogline
