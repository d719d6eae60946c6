// The files of config/ as they were when the program was built.
#pragma once

#include <span>
#include <string_view>

namespace hogline::config {

struct EmbeddedFile {
  std::string_view name;  ///< relative to config/, e.g. "rigs/practice.yaml"
  std::string_view content;
};

std::span<const EmbeddedFile> embedded_files();

/// The content of one of them. Precondition: it exists.
std::string_view embedded_file(std::string_view name);

}  // namespace hogline::config
