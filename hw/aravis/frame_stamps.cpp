#include "hw/aravis/frame_stamps.hpp"

#include <algorithm>

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

constexpr Duration window = 10s;
constexpr Duration bucket = 1s;
constexpr Duration longest_transfer = 1s;
constexpr Duration wall_tolerance = 2ms;  // beyond it the wall clock was stepped, not slewed
constexpr Duration camera_tolerance =
    1s;  // a stalled machine makes frames as late as that; beyond it the camera's clock jumped

}  // namespace

void ClockOffset::add(Stamp now, Duration difference) {
  while (!bests_.empty() && now - bests_.front().second > window) bests_.pop_front();
  if (bests_.empty() || now - bests_.back().second >= bucket) {
    bests_.push_back({now, difference});
  } else {
    bests_.back().difference = std::min(bests_.back().difference, difference);
  }
}

std::optional<Duration> ClockOffset::value() const {
  if (bests_.empty()) return std::nullopt;
  const auto least = std::min_element(bests_.begin(), bests_.end(),
                                      [](const Best& a, const Best& b) { return a.difference < b.difference; });
  return least->difference;
}

FrameStamps::FrameStamps(const AravisConfig& config)
    : meaning_(config.stamp), half_exposure_(from_seconds(0.5 * config.exposure_s)), latency_(config.latency) {}

void FrameStamps::restart() { offset_.forget(); }

Stamp FrameStamps::arrival_of(const CameraBuffer& buffer, const TimePair& now, FrameStamp& result) {
  const Duration wall_less_steady = now.wall - now.steady.time_since_epoch();
  const bool stepped = wall_less_steady_ && std::chrono::abs(wall_less_steady - *wall_less_steady_) > wall_tolerance;
  wall_less_steady_ = wall_less_steady;

  const Duration transfer = now.wall - buffer.wall;
  const bool usable = buffer.wall != Duration{} && transfer >= Duration{} && transfer <= longest_transfer && !stepped;
  result.wall_replaced = !usable;
  if (usable) transfer_ = transfer;
  return now.steady - transfer_;
}

FrameStamp FrameStamps::stamp_of(const CameraBuffer& buffer, const TimePair& now) {
  FrameStamp result;
  result.middle = arrival_of(buffer, now, result) - latency_ - half_exposure_;
  if (meaning_ == CameraStampMeaning::not_used || !buffer.camera) return result;

  const Duration middle =
      *buffer.camera + (meaning_ == CameraStampMeaning::exposure_start ? half_exposure_ : -half_exposure_);
  const Duration difference = result.middle.time_since_epoch() - middle;
  const auto known = offset_.value();
  if (known && std::chrono::abs(difference - *known) > camera_tolerance) {
    result.camera_jumped = true;
    offset_.forget();
  }
  offset_.add(now.steady, difference);
  result.middle = Stamp{middle + *offset_.value()};
  return result;
}

}  // namespace hogline::hw
