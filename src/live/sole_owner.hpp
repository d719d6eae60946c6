// A name of this machine that one living program has at a time.
#pragma once

#include <string>

namespace hogline {

class SoleOwner {
 public:
  /// Takes it: until this is destroyed, or the program ends, however that happens. Throws std::runtime_error where
  /// another program has it.
  explicit SoleOwner(const std::string& name);
  ~SoleOwner();
  SoleOwner(SoleOwner&& other) noexcept;
  SoleOwner& operator=(SoleOwner&&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace hogline
