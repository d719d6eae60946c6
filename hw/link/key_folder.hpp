// The files of a team's keys: all of them on the disk, or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hogline::hw::link {

/// Files that are new in a folder. What was made is removed again unless keep() was reached.
class KeyFolder {
 public:
  /// Makes the folder if it is not there. Throws LinkError.
  explicit KeyFolder(std::filesystem::path folder);
  ~KeyFolder();
  KeyFolder(const KeyFolder&) = delete;
  KeyFolder& operator=(const KeyFolder&) = delete;

  /// On the disk when it returns; a secret is readable by its owner alone. Never replaces a file. Throws LinkError.
  void add(const std::string& name, const std::string& text, bool secret);
  /// All is made. Throws LinkError.
  void keep();

 private:
  void undo() noexcept;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;  ///< folders before what is in them
  bool kept_ = false;
};

}  // namespace hogline::hw::link
