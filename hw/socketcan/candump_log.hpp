// The log format of can-utils (candump -L), line by line and apart from files:
//
//   (1795302065.451912) vcan0 601#4041600000000000
//   (1795302065.451990) vcan0 20000040#0000000000000000 R
//
// Three digits of identifier are a standard frame, eight an extended one, or an error frame where bit 29 is set. "#R"
// or
// "#R4" is a remote frame. A last letter R or T (candump -x) says whether the frame was received or transmitted.
#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hw/can_bus.hpp"

namespace hogline::hw {

enum class CanDirection { unknown, received, transmitted };

/// One line. In an error frame `frame.id` holds the error class bits (without bit 29) and `frame.data` their detail.
struct CandumpRecord {
  std::chrono::microseconds unix_time{};
  std::string interface;  ///< 1..15 characters, no white space
  CanFrame frame;
  bool error_frame = false;
  CanDirection direction = CanDirection::unknown;
  bool operator==(const CandumpRecord&) const = default;
};

/// The line without its line end. Precondition: unix_time >= 0 and the frame's length is at most 8.
std::string encode_candump_line(const CandumpRecord& record);

/// Either a record or the reason why the line is none. The reason is a constant, not part of the line.
struct CandumpLine {
  std::optional<CandumpRecord> record;
  std::string_view reason;
};

/// Total: any bytes give a record or a reason. A line end ("\n", "\r\n") may follow.
CandumpLine decode_candump_line(std::string_view line);

/// A whole log. Empty lines are skipped.
struct CandumpLog {
  struct Refused {
    std::size_t line = 0;  ///< counted from 1
    std::string_view reason;
  };
  std::vector<CandumpRecord> records;
  std::vector<Refused> refused;
};

/// Reads to the end of the stream. A line that is no record is listed, never dropped silently: the last line of a log
/// whose writer was killed is usually cut.
CandumpLog read_candump_log(std::istream& lines);

}  // namespace hogline::hw
