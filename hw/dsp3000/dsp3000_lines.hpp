// The KVH DSP-3000's text variant, bytes in, measurements out. No port, no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hw/dsp3000/measurement.hpp"

namespace hogline::hw::dsp3000 {

/// One line "(-)ddd.dddddd b" by its tokens; padding and line ends vary between devices. Nothing when it is not exactly
/// one finite number and one flag of 0 or 1.
std::optional<Measurement> parse_line(std::string_view line);

/// Cuts a stream of bytes into lines. The first line may be the rest of one and is thrown away.
class LineReader {
 public:
  /// The measurements that were completed by these bytes, in their order.
  std::vector<Measurement> feed(std::string_view bytes);
  /// What follows is another stream.
  void restart();
  std::uint64_t garbled() const { return garbled_; }  ///< lines that were no measurement

 private:
  std::optional<Measurement> finish_line();

  std::string line_;
  bool synchronised_ = false;
  std::uint64_t garbled_ = 0;
};

}  // namespace hogline::hw::dsp3000
