#include "src/doctor/gyro_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hogline::doctor {
namespace {

using namespace std::chrono_literals;

constexpr Duration listening = 1s;
constexpr Duration tick = 5ms;
constexpr double deg = 180.0 / std::numbers::pi;
// The device's bias is below 0.01 deg/s and the earth turns with 0.004: more is motion, or not a rate.
constexpr double at_rest_radps = 0.2 / deg;

struct Heard {
  std::vector<double> rates_radps;
  int invalid = 0;
  double worst_age_s = 0.0;
  Stamp first{};
  Stamp last{};
  int readings = 0;
};

Heard listen(hw::Gyro& gyro, Site& site) {
  Heard heard;
  for (const Stamp end = site.now() + listening; site.now() < end; site.pass(tick)) {
    gyro.step(site.now());
    const hw::GyroState state = gyro.state();
    if (state.stamp == Stamp{}) continue;
    heard.worst_age_s = std::max(heard.worst_age_s, seconds(site.now() - state.stamp));
    if (state.stamp == heard.last) continue;
    if (heard.readings++ == 0) heard.first = state.stamp;
    heard.last = state.stamp;
    if (state.valid) {
      heard.rates_radps.push_back(state.rate_radps);
    } else {
      ++heard.invalid;
    }
  }
  return heard;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Finding examine_gyro(Site& site) {
  Finding finding;
  finding.device = "gyro";
  finding.line = site.gyro_line();
  const Heard heard = listen(site.gyro(), site);
  const auto error = site.gyro().state().error;
  if (heard.readings == 0) {
    finding.found = "no reading";
    site.describe_gyro_silence(finding);
    if (!finding.remarks.empty()) return finding;
    const bool faulty = error && error->kind == hw::DeviceErrorKind::device_fault;
    finding.wrong(faulty ? "its readings are not valid: " + error->what
                         : "silent, or not understood: " + (error ? error->what : std::string("nothing arrives")),
                  faulty ? "let it warm up; if that does not help, it is broken"
                         : "check its power, the serial port, the baud rate and the variant");
    return finding;
  }
  const double rate_hz = heard.readings > 1 ? (heard.readings - 1) / seconds(heard.last - heard.first) : 0.0;
  finding.found = fmt::format("{:.0f} new readings a second, worst age {:.0f} ms", rate_hz, 1e3 * heard.worst_age_s);
  finding.values.emplace_back("readings_per_s", rate_hz);
  finding.values.emplace_back("worst_age_ms", 1e3 * heard.worst_age_s);
  finding.values.emplace_back("invalid_share", static_cast<double>(heard.invalid) / heard.readings);
  if (!heard.rates_radps.empty()) {
    const double rate_radps = median(heard.rates_radps);
    finding.found += fmt::format(", {:+.4f} deg/s", rate_radps * deg);
    finding.values.emplace_back("rate_degps", rate_radps * deg);
    if (std::abs(rate_radps) > at_rest_radps) {
      finding.wrong(fmt::format("says {:.2f} deg/s", rate_radps * deg),
                    "let the robot stand; if it does, the gyro is in another mode than rate (command R)");
    }
  }
  if (heard.invalid > 0) {
    finding.wrong(fmt::format("{} of {} readings are not valid", heard.invalid, heard.readings),
                  "let it warm up; if that does not help, it is broken or in another mode than rate");
  }
  if (error) {
    finding.wrong(fmt::format("{}: {}", to_string(error->kind), error->what), "check its cable and the serial port");
  }
  return finding;
}

}  // namespace hogline::doctor
