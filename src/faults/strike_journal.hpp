// What random strikes found, kept as they end: a campaign that was stopped goes on where it was.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/faults/random_faults.hpp"

namespace hogline::faults {

/// A file with a head (what is struck, by which program) and one JSON object a strike; each is written at once or, when
/// the program is killed, cut off when the file is taken up again.
class StrikeJournal {
 public:
  /// Begins a file, or takes one up. Throws ConfigError when it holds another campaign or is none; std::runtime_error
  /// when it can not be written.
  StrikeJournal(std::string path, const std::vector<const Case*>& faults, std::uint64_t seed,
                const std::string& program);

  const KnownStrikes& known() const { return known_; }
  void append(const StrikePlace& place, const RandomStrike& strike);

 private:
  void take_up(const std::string& head);

  std::string path_;
  std::vector<const Case*> faults_;
  std::uint64_t seed_;
  KnownStrikes known_;
};

}  // namespace hogline::faults
