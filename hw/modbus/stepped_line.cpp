#include <algorithm>
#include <string_view>
#include <utility>

#include "hw/modbus/modbus_line.hpp"

namespace hogline::hw {
namespace {

class SteppedLine final : public ModbusLine {
 public:
  explicit SteppedLine(ByteLine& bytes) : bytes_(bytes) {}

  std::optional<ModbusFault> open() override {
    if (auto why = bytes_.open()) return ModbusFault{DeviceErrorKind::disconnected, "connecting: " + *why};
    return std::nullopt;
  }
  void close() override { bytes_.close(); }
  void begin() override { static_cast<void>(bytes_.read()); }

  std::optional<ModbusFault> send(std::span<const std::uint8_t> bytes) override {
    if (bytes_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) return std::nullopt;
    return gone();
  }

  std::variant<std::size_t, ModbusFault> receive(std::span<std::uint8_t> buffer) override {
    const std::optional<std::string> arrived = bytes_.read();
    if (!arrived) return gone();
    if (arrived->empty()) return ModbusFault{DeviceErrorKind::timeout, "nothing arrives"};
    const std::size_t count = std::min(arrived->size(), buffer.size());
    std::copy_n(arrived->begin(), count, buffer.begin());
    return count;
  }

 private:
  static ModbusFault gone() { return {DeviceErrorKind::disconnected, "the other end closed the line"}; }

  ByteLine& bytes_;
};

}  // namespace

std::unique_ptr<ModbusLine> stepped_line(ByteLine& bytes) { return std::make_unique<SteppedLine>(bytes); }

}  // namespace hogline::hw
