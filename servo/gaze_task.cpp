#include "servo/gaze_task.hpp"

#include <visp3/core/vpException.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpAdaptiveGain.h>
#include <visp3/vs/vpServo.h>

#include <cmath>

namespace hogline::servo {
namespace {

// A point wider than this (70 degrees) is none of a camera's picture any more.
constexpr double widest = 2.75;

vpMatrix jacobian(const HeadGeometry& head, const HeadAngles& q) {
  const Eigen::Matrix<double, 6, 2> j = camera_jacobian(head, q);
  vpMatrix eJe(6, 2);
  for (unsigned int i = 0; i < 6; ++i) {
    for (unsigned int k = 0; k < 2; ++k) eJe[i][k] = j(static_cast<int>(i), static_cast<int>(k));
  }
  return eJe;
}

GazeLaw no_law(std::string reason) { return {false, std::move(reason), 0.0, 0.0}; }

}  // namespace

struct GazeTask::Task {
  HeadGeometry head;
  vpFeaturePoint now;
  vpFeaturePoint wanted;
  vpServo servo;

  Task(const HeadGeometry& geometry, const GazeGains& gains, double wanted_x, double wanted_y) : head(geometry) {
    servo.setServo(vpServo::EYEINHAND_L_cVe_eJe);
    servo.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
    servo.setLambda(vpAdaptiveGain(gains.at_zero_per_s, gains.at_infinity_per_s, gains.slope_per_s));
    servo.set_cVe(vpVelocityTwistMatrix());
    wanted.buildFrom(wanted_x, wanted_y, 1.0);
    now.buildFrom(wanted_x, wanted_y, 1.0);
    servo.addFeature(now, wanted, vpFeaturePoint::selectX() | vpFeaturePoint::selectY());
  }
  ~Task() { servo.kill(); }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
};

GazeTask::GazeTask(const HeadGeometry& head, const GazeGains& gains, double wanted_x, double wanted_y)
    : task_(std::make_unique<Task>(head, gains, wanted_x, wanted_y)) {}
GazeTask::~GazeTask() = default;
GazeTask::GazeTask(GazeTask&&) noexcept = default;
GazeTask& GazeTask::operator=(GazeTask&&) noexcept = default;

GazeLaw GazeTask::law(const HeadAngles& q, const SeenPoint& point, double x_per_s, double y_per_s) {
  const double sum = q.pan_rad + q.tilt_rad + point.x + point.y + point.depth_m + x_per_s + y_per_s;
  if (!std::isfinite(sum)) return no_law("angles or point are not finite");
  if (point.depth_m <= 0.0 || std::hypot(point.x, point.y) > widest) return no_law("the point is not in front");
  try {
    task_->now.buildFrom(point.x, point.y, point.depth_m);
    task_->servo.set_eJe(jacobian(task_->head, q));
    vpColVector rates = task_->servo.computeControlLaw();
    vpColVector own(2);
    own[0] = x_per_s;
    own[1] = y_per_s;
    rates -= task_->servo.getTaskJacobianPseudoInverse() * own;
    if (rates.size() != 2 || !std::isfinite(rates[0] + rates[1])) return no_law("the control law is not finite");
    return {true, {}, rates[0], rates[1]};
  } catch (const vpException& error) {
    return no_law(std::string("visual servoing failed: ") + error.getStringMessage());
  }
}

}  // namespace hogline::servo
