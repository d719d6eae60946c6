#include "src/config/embedded.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hogline::config {

std::string_view embedded_file(std::string_view name) {
  const auto files = embedded_files();
  const auto found = std::find_if(files.begin(), files.end(), [name](const EmbeddedFile& f) { return f.name == name; });
  if (found == files.end()) throw std::logic_error("no embedded file " + std::string(name));
  return found->content;
}

}  // namespace hogline::config
