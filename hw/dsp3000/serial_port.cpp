#include "hw/dsp3000/serial_port.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace hogline::hw {

namespace {

speed_t speed_of(int baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    default:
      throw std::invalid_argument("serial port: no driver knows " + std::to_string(baud) + " baud");
  }
}

std::string words_for(int error) { return std::generic_category().message(error); }

bool set_up(int descriptor, speed_t speed) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 1;  // with O_NONBLOCK: reading nothing is EAGAIN, and 0 is a line that hung up
  settings.c_cc[VTIME] = 0;
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

}  // namespace

SerialPort::SerialPort(const SerialPortConfig& config) : device_(config.device), speed_(speed_of(config.baud)) {}

std::optional<std::string> SerialPort::open() {
  close();
  descriptor_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return device_ + ": " + words_for(errno);
  if (!set_up(descriptor_, speed_)) {
    const int error = errno;
    close();
    return device_ + ": " + words_for(error);
  }
  ioctl(descriptor_, TIOCEXCL);
  tcflush(descriptor_, TCIOFLUSH);
  return std::nullopt;
}

void SerialPort::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

// To read or poll a terminal that has nothing makes the kernel wait for a worker of its own, which other programs hold
// up (160 ms measured on a busy machine, 2026-11-22): it is asked first how much there is.
std::optional<std::string> SerialPort::read() {
  if (descriptor_ < 0) return std::nullopt;
  if (int there = 0; ioctl(descriptor_, FIONREAD, &there) == 0 && there == 0) return std::string();
  std::string bytes;
  std::array<char, 4096> buffer{};
  for (;;) {
    const auto got = ::read(descriptor_, buffer.data(), buffer.size());
    if (got > 0) {
      bytes.append(buffer.data(), static_cast<std::size_t>(got));
      if (static_cast<std::size_t>(got) < buffer.size()) return bytes;
    } else if (got < 0 && errno == EAGAIN) {
      return bytes;
    } else if (got == 0 || errno != EINTR) {
      return std::nullopt;
    }
  }
}

bool SerialPort::write(std::string_view bytes) {
  return descriptor_ >= 0 && ::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

}  // namespace hogline::hw
