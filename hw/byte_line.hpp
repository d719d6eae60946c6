// Port: a line of bytes to a device, such as a serial port.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hogline::hw {

/// No call blocks.
class ByteLine {
 public:
  virtual ~ByteLine() = default;
  /// Opens it by its name, anew if it is open. Nothing when that went well, else why it did not.
  virtual std::optional<std::string> open() = 0;
  virtual void close() = 0;
  /// The bytes that have arrived and were not read before; nothing when the line is gone or was never opened.
  virtual std::optional<std::string> read() = 0;
  /// False when not all bytes could be handed over.
  virtual bool write(std::string_view bytes) = 0;
};

}  // namespace hogline::hw
