#include "vision/detect/point_pose.hpp"

#include <visp3/core/vpException.h>
#include <visp3/vision/vpPose.h>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace hogline::vision {
namespace {

double reprojection_of(const FourPoints& points, const Pose& eMc) {
  const Pose cMe = eMc.inverse();
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d c = cMe * Eigen::Vector3d(points.sheet[i].x(), points.sheet[i].y(), 0.0);
    sum += (c.head<2>() / c.z() - points.plane[i]).squaredNorm();
  }
  return std::sqrt(sum / 4.0);
}

std::optional<PointPose> checked(const FourPoints& points, const Pose& eMc) {
  if (!is_finite(eMc) || !(eMc.translation().z() > 0.0)) return std::nullopt;
  const double error = reprojection_of(points, eMc);
  if (!std::isfinite(error)) return std::nullopt;
  return PointPose{eMc, error};
}

}  // namespace

std::optional<PointPose> epnp(const FourPoints& points) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (std::size_t i = 0; i < 4; ++i) {
    object.emplace_back(points.sheet[i].x(), points.sheet[i].y(), 0.0);
    image.emplace_back(points.plane[i].x(), points.plane[i].y());
  }
  cv::Vec3d rotation;
  cv::Vec3d translation;
  try {
    if (!cv::solvePnP(object, image, cv::Matx33d::eye(), cv::noArray(), rotation, translation, false,
                      cv::SOLVEPNP_EPNP)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  Pose cMe = Pose::Identity();
  const Eigen::Vector3d r(rotation[0], rotation[1], rotation[2]);
  if (r.norm() > 0.0) cMe.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
  cMe.translation() << translation[0], translation[1], translation[2];
  return checked(points, cMe.inverse());
}

std::optional<PointPose> refine_pose(const FourPoints& points, const Pose& eMc) {
  try {
    vpPose pose;
    for (std::size_t i = 0; i < 4; ++i) {
      vpPoint point;
      point.setWorldCoordinates(points.sheet[i].x(), points.sheet[i].y(), 0.0);
      point.set_x(points.plane[i].x());
      point.set_y(points.plane[i].y());
      pose.addPoint(point);
    }
    const Pose start = eMc.inverse();
    vpHomogeneousMatrix cMe;
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 4; ++c) cMe[r][c] = start.matrix()(static_cast<int>(r), static_cast<int>(c));
    }
    pose.computePose(vpPose::VIRTUAL_VS, cMe);
    Pose refined = Pose::Identity();
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 4; ++c) refined.matrix()(static_cast<int>(r), static_cast<int>(c)) = cMe[r][c];
    }
    return checked(points, refined.inverse());
  } catch (const vpException&) {
    return std::nullopt;
  }
}

}  // namespace hogline::vision
