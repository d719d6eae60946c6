// Other programs, run by a test.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace hogline::hil {

/// A program in the background. It is killed and waited for when the object goes.
class Process {
 public:
  /// arguments[0] is searched in PATH. Its stdout goes to the file `output` if that is not empty. Throws
  /// std::system_error if it can not be started.
  explicit Process(const std::vector<std::string>& arguments, const std::string& output = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running();
  /// Waits for the end and gives the exit status (128 + signal if a signal ended it).
  int wait();
  void signal(int number);

 private:
  pid_t pid_ = -1;
  int status_ = -1;
};

/// Runs one shell line to its end; throws std::runtime_error if its exit status is not 0.
void run(const std::string& line);

}  // namespace hogline::hil
