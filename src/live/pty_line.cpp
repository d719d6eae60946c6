#include "src/live/pty_line.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace hogline {
namespace {

namespace fs = std::filesystem;

std::string words_for(int error) { return std::generic_category().message(error); }

// Another terminal's link, also one whose terminal is gone.
bool links_to_terminal(const fs::path& path) {
  std::error_code problem;
  return fs::is_symlink(fs::symlink_status(path, problem)) &&
         fs::read_symlink(path, problem).string().starts_with("/dev/pts/");
}

void make_link(const std::string& target, const std::string& path) {
  std::error_code problem;
  const bool stands = fs::exists(fs::symlink_status(path, problem));
  if (stands && !links_to_terminal(path)) {
    throw std::runtime_error(path + " stands where the simulated gyro's line is to be, and is no link to a terminal");
  }
  if (stands) fs::remove(path, problem);
  fs::create_symlink(target, path, problem);
  if (problem) throw std::runtime_error(path + ": " + problem.message());
}

}  // namespace

PtyLine::PtyLine(const std::string& path) : path_(path) {
  std::array<char, 128> name{};
  if (openpty(&descriptor_, &other_, nullptr, nullptr, nullptr) != 0 ||
      ttyname_r(other_, name.data(), name.size()) != 0) {
    throw std::runtime_error("no pseudo terminal: " + words_for(errno));
  }
  target_ = name.data();
  termios settings{};
  tcgetattr(other_, &settings);
  cfmakeraw(&settings);
  tcsetattr(other_, TCSANOW, &settings);
  fcntl(descriptor_, F_SETFL, O_NONBLOCK);
  make_link(target_, path_);
}

// A link that a later start has put there is not ours.
PtyLine::~PtyLine() {
  std::error_code problem;
  if (fs::read_symlink(path_, problem) == target_) fs::remove(path_, problem);
  ::close(other_);
  ::close(descriptor_);
}

// As SerialPort has it: to read a terminal that has nothing takes its time.
std::string PtyLine::read() const {
  if (int there = 0; ioctl(descriptor_, FIONREAD, &there) == 0 && there == 0) return {};
  std::array<char, 256> bytes{};
  const auto got = ::read(descriptor_, bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
}

void PtyLine::write(const std::string& bytes) const {
  if (!bytes.empty() && ::write(descriptor_, bytes.data(), bytes.size()) < 0) return;
}

}  // namespace hogline
