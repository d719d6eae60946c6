#include "tests/hil/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <system_error>

namespace hogline::hil {

namespace {

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const std::string& output) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!output.empty())
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int error = posix_spawnp(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), arguments[0]);
}

Process::~Process() {
  if (!running()) return;
  signal(SIGKILL);
  wait();
}

bool Process::running() {
  if (status_ >= 0) return false;
  int wait_status = 0;
  if (waitpid(pid_, &wait_status, WNOHANG) == 0) return true;
  status_ = exit_status(wait_status);
  return false;
}

int Process::wait() {
  int wait_status = 0;
  if (status_ < 0) {
    waitpid(pid_, &wait_status, 0);
    status_ = exit_status(wait_status);
  }
  return status_;
}

void Process::signal(int number) {
  if (status_ < 0) kill(pid_, number);
}

void run(const std::string& line) {
  const int status = Process({"/bin/sh", "-c", line}).wait();
  if (status != 0) throw std::runtime_error("'" + line + "' ended with " + std::to_string(status));
}

}  // namespace hogline::hil
