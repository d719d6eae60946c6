#include "src/live/line_writer.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string_view>

#include "src/live/process.hpp"

namespace hogline {
namespace {

constexpr auto pause = std::chrono::milliseconds(10);

// Who reads a pipe may make it one that does not wait, for all who have it.
bool has_room(int file) {
  constexpr int patience_ms = 1000;
  pollfd waiting{file, POLLOUT, 0};
  return poll(&waiting, 1, patience_ms) == 1 && (waiting.revents & POLLOUT) != 0;
}

// A full disk is no reason to stop: what can not be written is lost, and known to be.
bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN && has_room(file)) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

LineWriter::LineWriter(int file) : file_(file), thread_([this](const std::stop_token& stop) { run(stop); }) {}

LineWriter::~LineWriter() { flush(); }

bool LineWriter::flush() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  waiting_ += held_;
  held_.clear();
  write_out();
  return !lost_;
}

void LineWriter::post(const std::string& line) {
  if (file_ < 0) return;
  held_ += line;
  pump();
}

void LineWriter::pump() {
  if (held_.empty()) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  waiting_ += held_;
  held_.clear();
}

void LineWriter::write_out() {
  std::string lines;
  {
    const std::lock_guard lock(mutex_);
    lines.swap(waiting_);
  }
  if (!write_all(file_, lines)) lost_ = true;
}

void LineWriter::run(const std::stop_token& stop) {
  run_as_others();
  while (!stop.stop_requested()) {
    write_out();
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace hogline
