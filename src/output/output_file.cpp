#include "src/output/output_file.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(path + ": can not be written; check the folder and the disk's space");
}

}  // namespace

void check_folder(const std::string& option, const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (folder.empty() || error || !fs::is_directory(folder, error) || ::access(folder.c_str(), W_OK) != 0)
    throw config::ConfigError("command line", 0, option, folder, "must be a folder that can be written to");
}

void check_file(const std::string& option, const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw config::ConfigError("command line", 0, option, path, "is a folder; name a file in it");
  const fs::path folder = fs::path(path).parent_path();
  const bool there = fs::exists(path, error);
  if (::access(there ? path.c_str() : (folder.empty() ? "." : folder.c_str()), W_OK) != 0)
    throw config::ConfigError("command line", 0, option, path, "must be a file in a folder that can be written to");
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) refuse(path);
}

void replace_text(const std::string& path, const std::string& text) {
  const std::string draft = path + ".part";
  write_text(draft, text);
  std::error_code error;
  fs::rename(draft, path, error);
  if (error) refuse(path);
}

}  // namespace hogline
