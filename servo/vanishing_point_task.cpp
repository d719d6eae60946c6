#include "servo/vanishing_point_task.hpp"

#include <visp3/core/vpException.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/visual_features/vpFeatureVanishingPoint.h>
#include <visp3/vs/vpAdaptiveGain.h>
#include <visp3/vs/vpServo.h>
#include <Eigen/Core>
#include <cmath>

#include "servo/unicycle.hpp"

namespace hogline::servo {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Below this cosine to the optical axis the direction is not a point of the picture any more (80 degrees).
constexpr double least_forward_part = 0.17;

/// e's y axis, seen by the near camera of a body with this heading.
Eigen::Vector3d down_ice_in_camera(const RowMajor3& cRb, double heading_rad) {
  return cRb * Eigen::Vector3d(std::cos(heading_rad), -std::sin(heading_rad), 0.0);
}

vpVelocityTwistMatrix twist_matrix(const RowMajor3& cRb) {
  vpRotationMatrix rotation;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) rotation[i][j] = cRb(i, j);
  }
  // The mount's offset is left out: the feature does not depend on the camera's translation.
  return vpVelocityTwistMatrix(vpTranslationVector(0.0, 0.0, 0.0), rotation);
}

vpMatrix turning_matrix() {
  const std::array<double, 6> column = turning_jacobian();
  vpMatrix eJe(6, 1);
  for (unsigned int i = 0; i < 6; ++i) eJe[i][0] = column[i];
  return eJe;
}

VanishingPointLaw no_law(std::string reason) { return {false, std::move(reason), 0.0}; }

}  // namespace

struct VanishingPointTask::Task {
  RowMajor3 cRb;
  Eigen::Vector3d target;
  vpFeatureVanishingPoint seen;
  vpFeatureVanishingPoint wanted;
  vpServo servo;

  Task(const AlignmentConfig& config, double target_heading_rad)
      : cRb(Eigen::Map<const RowMajor3>(config.near_cRb.data())), target(down_ice_in_camera(cRb, target_heading_rad)) {
    servo.setServo(vpServo::EYEINHAND_L_cVe_eJe);
    servo.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
    servo.setLambda(
        vpAdaptiveGain(config.gain_at_zero_per_s, config.gain_at_infinity_per_s, config.gain_slope_per_s_rad));
    wanted.buildFrom(target.x() / target.z(), target.y() / target.z());
    servo.addFeature(seen, wanted, vpFeatureVanishingPoint::selectX() | vpFeatureVanishingPoint::selectY());
  }
  ~Task() { servo.kill(); }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
};

VanishingPointTask::VanishingPointTask(const AlignmentConfig& config, double target_heading_rad)
    : task_(std::make_unique<Task>(config, target_heading_rad)) {}
VanishingPointTask::~VanishingPointTask() = default;
VanishingPointTask::VanishingPointTask(VanishingPointTask&&) noexcept = default;
VanishingPointTask& VanishingPointTask::operator=(VanishingPointTask&&) noexcept = default;

VanishingPointLaw VanishingPointTask::law(double heading_rad) {
  if (!std::isfinite(heading_rad)) return no_law("heading is not finite");
  const Eigen::Vector3d direction = down_ice_in_camera(task_->cRb, heading_rad);
  if (direction.z() < least_forward_part || task_->target.z() < least_forward_part) {
    return no_law("the down-ice direction is not in front of the near camera");
  }
  try {
    task_->seen.buildFrom(direction.x() / direction.z(), direction.y() / direction.z());
    task_->servo.set_cVe(twist_matrix(task_->cRb));
    task_->servo.set_eJe(turning_matrix());
    const vpColVector rate = task_->servo.computeControlLaw();
    if (rate.size() != 1 || !std::isfinite(rate[0])) return no_law("the control law is not finite");
    return {true, {}, rate[0]};
  } catch (const vpException& error) {
    return no_law(std::string("visual servoing failed: ") + error.getStringMessage());
  }
}

}  // namespace hogline::servo
