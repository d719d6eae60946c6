// A curling stone's shape, and its outlines as a camera sees them. It stands on the ice: no refraction.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "vision/geometry/sheet.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// A round plate of the team's colour on a body of granite. The plate's upper rim is measured on site (the rig's
/// handle_radius_m and handle_height_m); the rest is what the rules leave free, and is refined in the picture.
struct StoneShape {
  double handle_radius_m = 0.095;
  double handle_height_m = 0.125;     ///< of the plate's upper rim over the ice
  double handle_thickness_m = 0.015;  ///< from the upper rim down to where the granite begins
  double rim_rounding_m = 0.0;        ///< radius of the upper rim's edge, where it was measured; 0: sharp
  double body_radius_m = 0.1435;      ///< at most 0.1455 by the rules' girth (R2 "Curling stones")
  double body_half_height_m = 0.057;  ///< of the ellipsoid that stands for the body; at least 0.0572 by the rules
};

/// How much lower than its height the upper rim of a rounded edge is seen at a distance along the ice: the line of
/// sight that just passes the edge touches it below the rim (geometry: an edge of 3 mm radius is seen 0.5 mm lower from
/// 10 degrees above the ice, 1.6 mm lower from 40).
double rim_lowering_m(const StoneShape& shape, double range_m, double eye_m);

/// The directions at a place on the sheet as the camera sees it.
struct Bearing {
  Eigen::Vector2d away;   ///< unit, on the ice, from the camera
  Eigen::Vector2d right;  ///< unit, to the right of `away`
  double range_m;         ///< along the ice from under the camera
};

Bearing bearing_of(const Eigen::Vector2d& place, const Eigen::Vector3d& camera);

/// An angle, for whoever needs it again and again. Wherever one is asked for, the plain angle will do.
struct Turn {
  double cosine, sine;
  Turn(double angle_rad) : cosine(std::cos(angle_rad)), sine(std::sin(angle_rad)) {}
};

/// A point of a level circle about a stone's axis, `turn` from the right, counter-clockwise: pi/2 is the far side.
Eigen::Vector3d circle_point(const Eigen::Vector2d& place, const Bearing& bearing, double radius_m, double height_m,
                             const Turn& turn);

/// A body's outline as the camera sees it. Precondition: the camera is outside the body.
class BodyOutline {
 public:
  BodyOutline(const Eigen::Vector2d& place, const StoneShape& shape, const Eigen::Vector3d& camera);

  /// `turn` about the line of sight from the right: pi/2 is the outline's top, -pi/2 its foot.
  Eigen::Vector3d at(const Turn& turn) const;

 private:
  Eigen::Vector3d half_, centre_;
  Eigen::Vector3d right_, up_, middle_;  ///< where the body is a ball of radius 1
  double radius_;
};

/// One point of it.
Eigen::Vector3d body_outline_point(const Eigen::Vector2d& place, const StoneShape& shape, const Eigen::Vector3d& camera,
                                   const Turn& turn);

}  // namespace hogline::vision
