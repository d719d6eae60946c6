#include "servo/thrown_stone_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

using State = Eigen::Matrix<double, motion_size, 1>;
using LookRow = Eigen::Matrix<double, 2, motion_size>;

constexpr double least_friction = 0.3;
constexpr double greatest_friction = 3.0;
constexpr double either_way_sigma = 0.8;

State state_of(const StoneMotion& m) {
  State u;
  u << m.stone.x_m, m.stone.y_m, m.stone.vx_mps, m.stone.vy_mps, m.ice.friction_scale, m.ice.curl_gain,
      m.ice.lateral_mps2, m.shared_sigmas[0], m.shared_sigmas[1];
  return u;
}

void set_state(StoneMotion& m, const State& u) {
  m.stone.x_m = u[0], m.stone.y_m = u[1], m.stone.vx_mps = u[2], m.stone.vy_mps = u[3];
  m.ice.friction_scale = std::clamp(u[4], least_friction, greatest_friction);
  m.ice.curl_gain = u[5];
  m.ice.lateral_mps2 = u[6];
  m.shared_sigmas = {u[7], u[8]};
}

LookRow look_row(const StoneMotion& m, const TrackLook& look) {
  LookRow row = LookRow::Zero();
  row.leftCols<2>().setIdentity();
  row.col(7 + static_cast<int>(look.view)) = look.tilt.at(m.stone.x_m, m.stone.y_m);
  return row;
}

void set_ice(StoneMotion& m, const IceEstimate& ice, double throw_friction_sigma) {
  m.ice = ice.factors();
  m.covariance.block<3, 3>(4, 4) =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(ice.covariance.data());
  m.covariance(4, 4) += std::pow(ice.friction_scale * throw_friction_sigma, 2);
  m.covariance.bottomRightCorner<view_count, view_count>().setIdentity();
}

}  // namespace

StoneMotion standing_stone(Stamp stamp, double x_m, double y_m, const PlaceCovariance& covariance,
                           const IceEstimate& ice) {
  StoneMotion m;
  m.stamp = stamp;
  m.stone = {x_m, y_m, 0.0, 0.0, 0.0};
  set_ice(m, ice, 0.0);
  m.covariance.topLeftCorner<2, 2>() << covariance.xx_m2, covariance.xy_m2, covariance.xy_m2, covariance.yy_m2;
  return m;
}

StoneMotion running_stone(Stamp stamp, const SlidingStone& stone, double place_sigma_m, double velocity_sigma_mps,
                          const IceEstimate& ice, double throw_friction_sigma) {
  StoneMotion m;
  m.stamp = stamp;
  m.stone = stone;
  set_ice(m, ice, throw_friction_sigma);
  m.covariance.diagonal().head<2>().setConstant(place_sigma_m * place_sigma_m);
  m.covariance.diagonal().segment<2>(2).setConstant(velocity_sigma_mps * velocity_sigma_mps);
  if (stone.spin_radps == 0.0) curl_either_way(m);
  return m;
}

void curl_either_way(StoneMotion& m) {
  m.stone.spin_radps = either_way_spin_radps;
  m.ice.curl_gain = 0.0;
  m.covariance.row(5).setZero();
  m.covariance.col(5).setZero();
  m.covariance(5, 5) = either_way_sigma * either_way_sigma;
}

IceEstimate curling_either_way(const IceEstimate& ice) {
  IceEstimate either = ice;
  either.curl_gain = 0.0;
  for (const std::size_t i : {1u, 3u, 5u, 7u}) either.covariance[i] = 0.0;
  either.covariance[4] = either_way_sigma * either_way_sigma;
  return either;
}

void advance(StoneMotion& m, Stamp to, const MotionNoise& noise) {
  const double dt_s = seconds(to - m.stamp);
  if (dt_s <= 0.0) return;
  m.stamp = to;
  const Slid slid = slide(m.stone, m.ice, dt_s);
  const double keep = std::exp(-dt_s / noise.shared_time_s);

  MotionCovariance transition = MotionCovariance::Identity();
  transition.topLeftCorner<4, 7>() = slid.by_start;
  for (int i = 7; i < motion_size; ++i) transition(i, i) = keep;
  m.covariance = transition * m.covariance * transition.transpose();
  m.covariance.diagonal().head<2>().array() += noise.place_m * noise.place_m * dt_s;
  if (!slid.at_rest) {
    m.covariance.diagonal().segment<2>(2).array() += noise.velocity_mps * noise.velocity_mps * dt_s;
    m.covariance(4, 4) += noise.friction * noise.friction * dt_s;
    m.covariance(5, 5) += noise.curl * noise.curl * dt_s;
  }
  for (int i = 7; i < motion_size; ++i) m.covariance(i, i) += 1.0 - keep * keep;
  m.stone = slid.stone;
  for (double& shared : m.shared_sigmas) shared *= keep;
}

Innovation innovation(const StoneMotion& m, const TrackLook& look) {
  const LookRow row = look_row(m, look);
  Innovation i;
  i.residual = Eigen::Vector2d(look.x_m, look.y_m) - row * state_of(m);
  i.covariance = row * m.covariance * row.transpose();
  i.covariance(0, 0) += look.covariance.xx_m2;
  i.covariance(1, 1) += look.covariance.yy_m2;
  i.covariance(0, 1) += look.covariance.xy_m2;
  i.covariance(1, 0) += look.covariance.xy_m2;
  i.square = i.residual.dot(i.covariance.inverse() * i.residual);
  i.log_density = -0.5 * i.square - 0.5 * std::log(i.covariance.determinant()) - std::log(2.0 * std::numbers::pi);
  return i;
}

void correct(StoneMotion& m, const TrackLook& look) {
  const LookRow row = look_row(m, look);
  const Innovation i = innovation(m, look);
  const Eigen::Matrix<double, motion_size, 2> gain = m.covariance * row.transpose() * i.covariance.inverse();
  const State u = state_of(m) + gain * i.residual;
  const MotionCovariance rest = MotionCovariance::Identity() - gain * row;
  const Eigen::Matrix2d own =
      (Eigen::Matrix2d() << look.covariance.xx_m2, look.covariance.xy_m2, look.covariance.xy_m2, look.covariance.yy_m2)
          .finished();
  m.covariance = rest * m.covariance * rest.transpose() + gain * own * gain.transpose();
  set_state(m, u);
}

}  // namespace hogline::servo
