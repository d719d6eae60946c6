// A reason that stays.
#pragma once

#include <optional>
#include <string>

namespace hogline::servo {

/// Keeps the first reason.
class Latch {
 public:
  void set(const std::optional<std::string>& reason) {
    if (!reason_ && reason) reason_ = reason;
  }
  const std::optional<std::string>& reason() const { return reason_; }

 private:
  std::optional<std::string> reason_;
};

}  // namespace hogline::servo
