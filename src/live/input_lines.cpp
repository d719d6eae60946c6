#include "src/live/input_lines.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace hogline {
namespace {

constexpr std::size_t longest = 4096;
constexpr std::size_t shown = 40;  // of what is longer, which nobody means as words

}  // namespace

std::optional<std::string> InputLines::line() {
  pollfd waiting{STDIN_FILENO, POLLIN, 0};
  if (open_ && poll(&waiting, 1, 0) == 1) {
    std::array<char, 256> bytes{};
    const auto got = read(STDIN_FILENO, bytes.data(), bytes.size());
    const bool later = got < 0 && (errno == EINTR || errno == EAGAIN);
    open_ = got > 0 || later;
    if (got > 0) said_.append(bytes.data(), static_cast<std::size_t>(got));
  }
  const auto end = said_.find('\n');
  if (end == std::string::npos) {
    if (said_.size() > longest) said_ = said_.substr(0, shown) + "...";  // whoever reads it will refuse it
    return std::nullopt;
  }
  const std::string line = said_.substr(0, end);
  said_.erase(0, end + 1);
  return line;
}

}  // namespace hogline
