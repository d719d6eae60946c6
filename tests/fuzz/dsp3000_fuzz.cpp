// DSP-3000: any bytes, in pieces and with time going on, into both variants of the gyro adapter.
#include <cmath>
#include <string>

#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "tests/fuzz/require.hpp"

namespace hogline::fuzz {
namespace {

using namespace std::chrono_literals;

// Gives the next piece of the input; a piece of a certain length is a line that is gone.
class FuzzedLine final : public hw::ByteLine {
 public:
  FuzzedLine(const std::uint8_t* data, std::size_t size) : rest_(reinterpret_cast<const char*>(data), size) {}
  bool empty() const { return rest_.empty(); }
  std::optional<std::string> open() override { return std::nullopt; }
  void close() override {}
  std::optional<std::string> read() override {
    if (rest_.empty()) return std::string();
    const auto length = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    if (length == 255) return std::nullopt;
    const std::string piece(rest_.substr(0, length));
    rest_.remove_prefix(piece.size());
    return piece;
  }
  bool write(std::string_view) override { return true; }

 private:
  std::string_view rest_;
};

}  // namespace
}  // namespace hogline::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hogline::fuzz;
  if (size == 0) return 0;
  const bool binary = (data[0] & 1U) != 0;
  FuzzedLine line(data + 1, size - 1);
  hogline::hw::Dsp3000Gyro gyro(
      line, {.variant = binary ? hogline::hw::Dsp3000Variant::binary : hogline::hw::Dsp3000Variant::text,
             .sign = (data[0] & 2U) != 0 ? 1.0 : -1.0,
             .latitude_rad = 0.6,
             .latency = 3ms,
             .silence_limit = 30ms,
             .mode_deadline = 100ms,
             .reopen_delay = 50ms,
             .max_rate_radps = 1.6,
             .max_slew_radps2 = 35.0,
             .stuck_limit = 100ms,
             .rest_window = 100ms,
             .max_bias_radps = 0.002,
             .max_bias_step_radps = 0.001});
  hogline::Stamp now{std::chrono::seconds(1)};
  for (int i = 0; i < 20 || !line.empty(); ++i) {
    now += 5ms;
    gyro.at_rest((data[0] & 4U) != 0);
    if (i % 64 == 63) gyro.rearm();
    gyro.step(now);
    const auto state = gyro.state();
    require(std::isfinite(state.rate_radps) && std::abs(state.rate_radps) <= 1.61, "a rate is in range");
    require(!state.valid || (gyro.verified() && state.stamp <= now), "valid is verified and not of the future");
    require(!state.bias || (std::isfinite(state.bias->radps) && state.bias->sigma_radps >= 0.0), "a bias is a number");
    require(!state.error || !state.error->what.empty(), "an error has words");
  }
  return 0;
}
