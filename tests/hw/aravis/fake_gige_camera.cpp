#include "tests/hw/aravis/fake_gige_camera.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>

#include "tests/hw/eventually.hpp"

#if defined(__SANITIZE_THREAD__)
// Debian's libaravis and libglib are built without ThreadSanitizer: it sees them write into buffers, but not the locks
// under which they hand them over.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libaravis-0.8.so\ncalled_from_lib:libglib-2.0.so\ncalled_from_lib:libgobject-2.0.so\n"
         "called_from_lib:libgio-2.0.so\n";
}
#endif

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t control_port = 3956;  // GVCP

bool port_taken() {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(control_port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool taken = bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0;
  close(fd);
  return taken;
}

}  // namespace

FakeGigeCamera::FakeGigeCamera(std::string serial, std::vector<std::string> options)
    : lock_(open("/tmp/hogline-gige-test.lock", O_RDWR | O_CREAT | O_CLOEXEC, 0666)),
      serial_(std::move(serial)),
      options_(std::move(options)) {
  if (lock_ < 0) throw std::runtime_error("/tmp/hogline-gige-test.lock can not be opened");
  if (!comes_true([this] { return flock(lock_, LOCK_EX | LOCK_NB) == 0; })) {
    throw std::runtime_error("another test has held the loopback's GigE port for a minute");
  }
  start();
}

FakeGigeCamera::~FakeGigeCamera() {
  kill();
  close(lock_);
}

void FakeGigeCamera::start() {
  if (!comes_true([] { return !port_taken(); })) {
    throw std::runtime_error("another program holds UDP port 3956 of 127.0.0.1; end it to run this test");
  }
  // Killed by the kernel if this test dies.
  std::vector<std::string> words{"setpriv", "--pdeathsig", "KILL", "arv-fake-gv-camera-0.8",
                                 "-i",      "127.0.0.1",   "-s",   serial_};
  words.insert(words.end(), options_.begin(), options_.end());
  process_ = std::make_unique<hil::Process>(words, "/dev/null");
  if (!comes_true([this] { return port_taken() || !process_->running(); }) || !process_->running()) {
    throw std::runtime_error("arv-fake-gv-camera-0.8 (package aravis-tools) does not start");
  }
}

void FakeGigeCamera::kill() {
  if (!process_) return;
  process_->signal(SIGKILL);
  process_->wait();
  process_.reset();
}

}  // namespace hogline::hw
