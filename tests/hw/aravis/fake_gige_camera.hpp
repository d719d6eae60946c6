// Aravis' own fake GigE Vision camera as a program of its own, on the loopback interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/hil/process.hpp"

namespace hogline::hw {

/// There is room for one on a machine (UDP port 3956 of 127.0.0.1), so the object holds a lock of the whole machine.
class FakeGigeCamera {
 public:
  /// Waits for the lock, starts the program and waits until it holds the port. Throws std::runtime_error otherwise.
  explicit FakeGigeCamera(std::string serial, std::vector<std::string> options = {});
  ~FakeGigeCamera();
  FakeGigeCamera(const FakeGigeCamera&) = delete;
  FakeGigeCamera& operator=(const FakeGigeCamera&) = delete;

  void kill();   ///< as if its plug were pulled
  void start();  ///< again
  void signal(int number) { process_->signal(number); }

 private:
  int lock_ = -1;
  std::string serial_;
  std::vector<std::string> options_;
  std::unique_ptr<hil::Process> process_;
};

}  // namespace hogline::hw
