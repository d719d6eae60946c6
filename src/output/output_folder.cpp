#include "src/output/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "src/config/config_error.hpp"
#include "src/output/output_file.hpp"

namespace hogline {

// The folder itself is locked: no file of a lock is left in it, and the kernel lets go when its holder dies.
OutputFolder::OutputFolder(const std::string& option, const std::string& folder) {
  check_folder(option, folder);
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int why = errno;
  if (descriptor_ >= 0 && why == EWOULDBLOCK) {
    ::close(descriptor_);
    throw config::ConfigError("command line", 0, option, folder,
                              "another program is writing into this folder; name another one, or wait for its end");
  }
  fmt::print(stderr, "{}: can not be locked ({}): see to it that no other program writes there\n", folder,
             std::generic_category().message(why));
}

OutputFolder::~OutputFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace hogline
