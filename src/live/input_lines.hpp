// An operator's words on stdin, a line each, without waiting for them.
#pragma once

#include <optional>
#include <string>

namespace hogline {

/// Whoever closes stdin has nothing more to say. Of a line that is longer than 4096 only its beginning and its end are
/// kept, with "..." between.
class InputLines {
 public:
  std::optional<std::string> line();

 private:
  bool open_ = true;
  std::string said_;
};

}  // namespace hogline
