// Modbus requests and answers as bytes, for TCP and RTU; no IO. Source: MODBUS Application Protocol V1.1b3, MODBUS
// Messaging on TCP/IP V1.0b, MODBUS over Serial Line V1.02.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hogline::hw::modbus {

/// TCP puts a header of seven bytes before function and data; RTU puts the unit before and a CRC behind.
enum class Framing { tcp, rtu };

/// Registers of one unit: function 4 reads `count` of them, function 16 writes `values`.
struct Request {
  std::uint8_t unit = 0;
  std::uint16_t address = 0;
  std::uint16_t count = 0;  ///< 1..125 to read, 1..123 to write
  std::vector<std::uint16_t> values{};

  bool writes() const { return !values.empty(); }
};

/// Preconditions: count in its range; values empty, or count of them.
Request read_input_registers(int unit, int address, std::size_t count);
Request write_registers(int unit, int address, std::span<const std::uint16_t> values);

/// The bytes to send. `transaction` is TCP's; RTU has none.
std::vector<std::uint8_t> encode(const Request& request, Framing framing, std::uint16_t transaction);

enum class Verdict {
  incomplete,  ///< nothing wrong so far, bytes are missing
  good,        ///< the answer to this very request
  exception,   ///< the unit says no; `exception` is its code
  wrong,       ///< not an answer to this request; `reason` says why
};

struct Answer {
  Verdict verdict = Verdict::incomplete;
  std::vector<std::uint16_t> values{};  ///< of a good answer to a read: count of them
  int exception = 0;
  std::string_view reason{};  ///< a constant
};

/// Judges what has arrived. Total: any bytes give a verdict. Everything that the standard repeats from the request is
/// compared with it: transaction, unit, function, byte count or address and count; and TCP's length or RTU's CRC.
Answer judge(std::span<const std::uint8_t> bytes, const Request& request, Framing framing, std::uint16_t transaction);

/// The CRC of MODBUS over Serial Line, 6.2.2 (polynomial A001, from FFFF); its low byte is sent first.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// The standard's words for an exception code.
std::string_view exception_meaning(int code);

}  // namespace hogline::hw::modbus
