#include "src/doctor/serial_device.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace hogline::doctor {

void describe_serial_device(const std::string& path, Finding& finding) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  const int error = errno;
  if (descriptor >= 0) {
    if (::isatty(descriptor) == 0) {
      finding.wrong(path + " is no serial port", "name the port in the rig: ls /dev/serial/by-id");
    }
    ::close(descriptor);
  } else if (error == EACCES) {
    finding.wrong("no permission to open " + path, "add yourself to its group (ls -l; often dialout) and log in again");
  } else if (error == EISDIR) {
    finding.wrong(path + " is a folder", "name the port in the rig: ls /dev/serial/by-id");
  } else if (error == EBUSY) {
    finding.wrong(path + " is in use", "end the other program that holds it");
  } else {
    finding.wrong(fmt::format("{} can not be opened: {}", path, std::strerror(error)),
                  "plug the adapter in, or correct its name in the rig: ls /dev/serial/by-id");
  }
}

}  // namespace hogline::doctor
