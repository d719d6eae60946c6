#include "src/config/embedded.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::config {

std::string_view embedded_file(std::string_view name) {
  const auto files = embedded_files();
  const auto found = std::find_if(files.begin(), files.end(), [name](const EmbeddedFile& f) { return f.name == name; });
  assert(found != files.end());
  return found->content;
}

}  // namespace hogline::config
