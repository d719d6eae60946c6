// A known camera over a known sheet, for the tests of the detection's steps. No lens distortion, no ice.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/ground_view.hpp"
#include "vision/detect/line_candidates.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::vision::testing {

struct SheetView {
  explicit SheetView(const PlanarPose& at)
      : body(at),
        setup{{1600, 1200, LensModel::brown_conrady, 780.0, 780.0, 799.5, 599.5, {}},
              {0.2, 0.0, 2.0, 0.0, 0.489, 0.0},
              1.0,
              {},
              {}},
        view(setup),
        eMc(eMb(at) * bMc(setup.mount)) {}

  /// Undistorted picture plane of a point on the ice.
  Eigen::Vector2d plane(double x, double y) const { return (eMc.inverse() * Eigen::Vector3d(x, y, 0.0)).hnormalized(); }

  Eigen::Vector3d line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    return plane(a.x(), a.y()).homogeneous().cross(plane(b.x(), b.y()).homogeneous());
  }

  LineCandidate candidate(const Eigen::Vector2d& a, const Eigen::Vector2d& b, int votes = 100) const {
    const Eigen::Vector3d l = line(a, b);
    LineCandidate c;
    c.normal = l.head<2>() / l.head<2>().norm();
    c.rho = -l.z() / l.head<2>().norm();
    c.votes = votes;
    c.begin = plane(a.x(), a.y());
    c.end = plane(b.x(), b.y());
    return c;
  }

  /// The outer ring's conic: the circle's matrix carried by the homography of the ice.
  Eigen::Matrix3d ring() const {
    const Pose cMe = eMc.inverse();
    Eigen::Matrix3d H;
    H << cMe.linear().col(0), cMe.linear().col(1), cMe.translation();
    const double R = rules::outer_ring_radius_m;
    const Eigen::Matrix3d inverse = H.inverse();
    const Eigen::Matrix3d C = inverse.transpose() * Eigen::Vector3d(1.0, 1.0, -R * R).asDiagonal() * inverse;
    return C / C.norm();
  }

  /// A point of an edge on the sheet, lighter towards `normal`. Filled as the edge finder does.
  EdgePoint edge(const Eigen::Vector2d& at, const Eigen::Vector2d& normal) const {
    const Pose gMe = eMb(PlanarPose{}) * eMb(body).inverse();
    EdgePoint p;
    p.ground = (gMe * Eigen::Vector3d(at.x(), at.y(), 0.0)).head<2>();
    p.ground_normal = gMe.linear().topLeftCorner<2, 2>() * normal;
    p.plane = plane(at.x(), at.y());
    const Eigen::Vector2d along(-normal.y(), normal.x());
    const Eigen::Vector2d a = at - 0.01 * along;
    const Eigen::Vector2d b = at + 0.01 * along;
    const Eigen::Vector2d side = at + 0.01 * normal;
    const Eigen::Vector2d t = (plane(b.x(), b.y()) - plane(a.x(), a.y())).normalized();
    p.plane_normal << -t.y(), t.x();
    if (p.plane_normal.dot(plane(side.x(), side.y()) - p.plane) < 0.0) p.plane_normal = -p.plane_normal;
    p.pixel = *view.pixel_of_plane(p.plane);
    return p;
  }

  PlanarPose body;
  CameraSetup setup;
  GroundView view;
  Pose eMc;
};

}  // namespace hogline::vision::testing
