#include "hw/link/key_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "hw/link/link_error.hpp"

namespace hogline::hw::link {
namespace {

namespace fs = std::filesystem;

class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

// Reads errno.
[[noreturn]] void fail(const fs::path& path) {
  throw LinkError(fmt::format("{}: can not be written: {}; no keys were made", path.string(),
                              std::generic_category().message(errno)));
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

KeyFolder::KeyFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::path path;
  for (const fs::path& part : folder_) {
    path /= part;
    if (fs::is_directory(path, error)) continue;
    if (::mkdir(path.c_str(), 0777) == 0) {
      made_.push_back(path);
    } else if (errno != EEXIST) {
      const int why = errno;
      undo();
      errno = why;
      fail(path);
    }
  }
}

KeyFolder::~KeyFolder() { undo(); }

void KeyFolder::undo() noexcept {
  if (kept_) return;
  std::error_code ignored;
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
  made_.clear();
}

void KeyFolder::add(const std::string& name, const std::string& text, bool secret) {
  const fs::path path = folder_ / name;
  const mode_t mode = secret ? 0600 : 0644;
  File file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!file.is_open()) fail(path);
  made_.push_back(path);
  if (::fchmod(file.get(), mode) != 0 || !write_all(file.get(), text) || ::fsync(file.get()) != 0 || !file.close())
    fail(path);
}

void KeyFolder::keep() {
  File folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.is_open() || ::fsync(folder.get()) != 0) fail(folder_);
  kept_ = true;
}

}  // namespace hogline::hw::link
