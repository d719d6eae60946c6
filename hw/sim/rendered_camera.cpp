#include "hw/sim/rendered_camera.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::hw::sim {
namespace {

constexpr Duration late_by = std::chrono::milliseconds(120);
constexpr Duration back_by = std::chrono::milliseconds(100);
constexpr Duration ahead_by = std::chrono::milliseconds(200);
constexpr double glare_level = 4.0;      // of full scale
constexpr double covered_level = 0.004;  // of full scale: what leaks in when the head is folded away

// A standard normal number that belongs to a frame.
double normal_of(std::uint64_t seed, std::uint64_t id) {
  const double a = uniform_of(mixed_bits(seed + 2 * id));
  const double b = uniform_of(mixed_bits(seed + 2 * id + 1));
  return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
}

// The camera is carried along: its origin moves with the body and with the body's turning.
vision::Twist carried(const BodyMotion& body, const vision::Pose& eMc) {
  const Eigen::Vector3d lever = eMc.translation() - body.eMb.translation();
  return {body.velocity.linear + body.velocity.angular.cross(lever), body.velocity.angular};
}

}  // namespace

RenderedCamera::RenderedCamera(SheetRenderer renderer, const vision::Pose& bMc, const CameraTiming& timing,
                               CameraWorld world, std::uint64_t seed)
    : renderer_(std::move(renderer)), bMc_(bMc), timing_(timing), world_(std::move(world)), seed_(seed) {
  assert(timing.rate_hz > 0.0 && timing.exposure_s >= 0.0 && timing.min_latency_s <= timing.max_latency_s);
  assert(world_.body != nullptr);
}

Stamp RenderedCamera::stamp_of(std::uint64_t id) const {
  return Stamp{timing_.start + from_seconds(static_cast<double>(id) / timing_.rate_hz)};
}

Stamp RenderedCamera::own_arrival(std::uint64_t id) const {
  const double late_s = timing_.latency_s + timing_.latency_jitter_s * normal_of(seed_, id);
  return stamp_of(id) + from_seconds(std::clamp(late_s, timing_.min_latency_s, timing_.max_latency_s));
}

Stamp RenderedCamera::arrival_of(std::uint64_t id) const {
  Stamp arrival = own_arrival(id);
  // A frame can be overtaken only by those exposed within the spread of the latency.
  const double spread_frames = (timing_.max_latency_s - timing_.min_latency_s) * timing_.rate_hz;
  const auto earlier = std::min(id, static_cast<std::uint64_t>(std::ceil(spread_frames)));
  for (std::uint64_t k = 1; k <= earlier; ++k) arrival = std::max(arrival, own_arrival(id - k));
  return arrival;
}

std::optional<std::uint64_t> RenderedCamera::newest(Stamp now) const {
  const double age_s = seconds(now.time_since_epoch() - timing_.start) - timing_.min_latency_s;
  if (age_s < 0.0) return std::nullopt;
  auto id = static_cast<std::uint64_t>(std::floor(age_s * timing_.rate_hz)) + 1;
  while (arrival_of(id) > now) {
    if (id == 0) return std::nullopt;
    --id;
  }
  return id;
}

cv::Mat RenderedCamera::take(std::uint64_t id, Stamp stamp) const {
  const BodyMotion body = world_.body(stamp);
  Exposure exposure;
  exposure.eMc = body.eMb * bMc_;
  exposure.velocity = carried(body, exposure.eMc);
  exposure.duration_s = timing_.exposure_s;
  const bool blind = fault_ == Fault::black || fault_ == Fault::saturated;
  const bool uncovered = !blind && (world_.uncovered == nullptr || world_.uncovered(stamp));
  if (uncovered && world_.things != nullptr) world_.things(stamp, exposure);

  cv::Mat bgr;
  const std::uint64_t frame_seed = mixed_bits(seed_ ^ mixed_bits(id));
  if (uncovered) {
    renderer_.render(exposure, frame_seed, bgr);
  } else {
    renderer_.render_darkness(fault_ == Fault::saturated ? glare_level : covered_level, frame_seed, bgr);
  }
  return bgr;
}

std::optional<Frame> RenderedCamera::latest(Stamp now) {
  const auto id = newest(fault_ == Fault::late ? now - late_by : now);
  if (!id || (given_ && *id <= *given_)) return std::nullopt;
  given_ = id;
  if (fault_ == Fault::stopped) return std::nullopt;
  if (fault_ == Fault::frozen) {
    if (!last_) return std::nullopt;
    return Frame{last_->bgr.clone(), last_->stamp, *id};
  }
  if (fault_ == Fault::repeated && last_) return Frame{last_->bgr.clone(), stamp_of(*id), *id};
  Frame frame{take(*id, stamp_of(*id)), stamp_of(*id), *id};
  if (fault_ == Fault::time_back) frame.stamp -= back_by;
  if (fault_ == Fault::ahead) frame.stamp += ahead_by;
  last_ = Frame{frame.bgr, frame.stamp, frame.id};
  return frame;
}

}  // namespace hogline::hw::sim
