// The KVH DSP-3000's binary variant, bytes in, measurements out. No port, no clock. Source: the maker's manual 54-0215,
// 3.1: words of 32 bits, the most significant byte first. Bit 31 valid, 30-29 synchronisation, 28-27 type (0 rate, 1
// incremental angle, 2 integrated angle), 26 odd parity of the whole word, 25-0 two's complement, 60e-6 deg/s each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hw/dsp3000/measurement.hpp"

namespace hogline::hw::dsp3000 {

/// Nothing when the parity is wrong, the type is none, or a rate is beyond what the device can say (503 deg/s).
std::optional<Measurement> decode_word(std::uint32_t word);

/// Finds where words begin and cuts the stream there. No byte says so: a place is believed after eight good words of
/// one mode in a row that are marked valid, and given up after four bad ones.
class WordReader {
 public:
  /// The measurements that were completed by these bytes, in their order.
  std::vector<Measurement> feed(std::string_view bytes);
  /// What follows is another stream.
  void restart();
  std::uint64_t garbled() const { return garbled_; }  ///< words that were no measurement

 private:
  std::optional<Measurement> take(std::uint32_t word);
  void look_for_words();

  std::array<int, 4> good_in_a_row_{};  ///< for each place modulo 4, while looking
  std::array<Mode, 4> mode_{};
  std::uint32_t newest_ = 0;  ///< the last four bytes
  std::uint64_t bytes_ = 0;   ///< since the restart
  std::optional<unsigned> place_;
  int bad_in_a_row_ = 0;
  std::uint64_t garbled_ = 0;
};

}  // namespace hogline::hw::dsp3000
