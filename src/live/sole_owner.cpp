#include "src/live/sole_owner.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hogline {

// An abstract socket's name goes with its last descriptor: nothing is left behind that would have to be cleared away.
SoleOwner::SoleOwner(const std::string& name) {
  const std::string hashed = fmt::format("hogline-{:016x}", std::hash<std::string>{}(name));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy(hashed, address.sun_path + 1);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + hashed.size());
  descriptor_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
  if (bind(descriptor_, reinterpret_cast<sockaddr*>(&address), length) == 0) return;
  const int problem = errno;
  close(descriptor_);
  if (problem == EADDRINUSE) throw std::runtime_error(name + " is another running program's");
  throw std::system_error(problem, std::generic_category(), name);
}

SoleOwner::SoleOwner(SoleOwner&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

SoleOwner::~SoleOwner() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace hogline
