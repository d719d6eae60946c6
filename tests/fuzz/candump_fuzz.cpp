// candump logs: any text is records and refused lines, and what was read is written as it reads.
#include <cstdint>
#include <sstream>
#include <string>

#include "hw/socketcan/candump_log.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using hogline::fuzz::require;
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  const auto log = hogline::hw::read_candump_log(text);
  for (const auto& refused : log.refused) {
    require(refused.line > 0 && !refused.reason.empty(), "a refused line has a number and a reason");
  }
  for (const auto& record : log.records) {
    require(record.frame.length <= 8 && record.unix_time.count() >= 0, "a record is a classic frame with a time");
    const auto again = hogline::hw::decode_candump_line(hogline::hw::encode_candump_line(record));
    require(again.record.has_value() && *again.record == record, "a record survives the round trip");
  }
  return 0;
}
