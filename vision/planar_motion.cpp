#include "vision/planar_motion.hpp"

#include <algorithm>
#include <cassert>

#include "vision/geometry/pose.hpp"

namespace hogline::vision {

void PlanarMotion::add(Stamp stamp, const PlanarPose& body) {
  assert(count_ == 0 || stamp > last_stamp());
  if (count_ == most_places) {
    std::copy(places_.begin() + 1, places_.end(), places_.begin());
    --count_;
  }
  places_[count_++] = {stamp, body};
}

PlanarPose PlanarMotion::at(Stamp stamp) const {
  assert(!empty());
  PlanarPose body = last();
  if (!known()) return body;
  const double n = static_cast<double>(count_);
  double sum_t = 0.0;
  for (std::size_t i = 0; i < count_; ++i) sum_t += seconds(places_[i].stamp - last_stamp());
  const double mean_t = sum_t / n;
  double square = 0.0;
  PlanarPose rate;
  for (std::size_t i = 0; i < count_; ++i) {
    const double t = seconds(places_[i].stamp - last_stamp()) - mean_t;
    square += t * t;
    rate.x_m += t * places_[i].body.x_m;
    rate.y_m += t * places_[i].body.y_m;
    rate.yaw_rad += t * wrapped(places_[i].body.yaw_rad - last().yaw_rad);
  }
  const double dt_s = seconds(stamp - last_stamp());
  body.x_m += rate.x_m / square * dt_s;
  body.y_m += rate.y_m / square * dt_s;
  body.yaw_rad = wrapped(body.yaw_rad + rate.yaw_rad / square * dt_s);
  return body;
}

}  // namespace hogline::vision
