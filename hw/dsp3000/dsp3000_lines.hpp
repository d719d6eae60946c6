// The KVH DSP-3000's text in rate mode, bytes in, measurements out. No port, no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hogline::hw::dsp3000 {

struct Measurement {
  double rate_radps = 0.0;  ///< with the device's own sign
  bool valid = false;       ///< the device's own flag
};

/// One line "(-)ddd.dddddd b" by its tokens; padding and line ends vary between devices. Nothing when it is not exactly
/// one finite number and one flag of 0 or 1.
std::optional<Measurement> parse_line(std::string_view line);

/// Cuts a stream of bytes into lines. The first line may be the rest of one and is thrown away.
class LineReader {
 public:
  /// The newest complete measurement among the bytes, if there is one.
  std::optional<Measurement> feed(std::string_view bytes);
  std::uint64_t garbled() const { return garbled_; }  ///< lines that were no measurement

 private:
  std::optional<Measurement> finish_line();

  std::string line_;
  bool synchronised_ = false;
  std::uint64_t garbled_ = 0;
};

}  // namespace hogline::hw::dsp3000
