// Everything in the picture that is not paint: the hall, stones, people. Asked ray by ray.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "hw/sim/appearance.hpp"
#include "hw/sim/sheet_paint.hpp"

namespace hogline::hw::sim {

/// A ray in e; the direction need not be of unit length.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
};

/// What a ray meets. `colour` is lit already: 1 is a white surface in the light.
struct Hit {
  float distance = 0.0F;  ///< in lengths of the ray's direction
  Colour colour;
};

/// The box around the ice, seen from inside it.
class Hall {
 public:
  Hall(const HallAppearance& look, const IceBounds& bounds);

  /// What the hall shows to a ray. `material` tells apart what must not be blended; nothing where the ray meets the
  /// ice.
  struct View {
    Colour colour;
    int material = 0;
  };
  std::optional<View> look(const Ray& ray) const;

  /// The lamps' centres along x, and along y the first one and the spacing.
  const std::array<float, 3>& lamp_columns_m() const { return lamp_columns_m_; }
  const HallAppearance& appearance() const { return look_; }
  const IceBounds& ice() const { return ice_; }

 private:
  View boards(int side, float z_m) const;
  View wall(int side, float along_m, float z_m) const;
  View ceiling(float x_m, float y_m) const;

  HallAppearance look_;
  IceBounds ice_;
  std::array<float, 3> lamp_columns_m_;
};

/// A stone or a person: a few simple bodies and the ball around them.
class Solid {
 public:
  static Solid stone(const StoneLook& look);
  static Solid person(const PersonLook& look);

  std::optional<Hit> meet(const Ray& ray) const;
  const Eigen::Vector3f& centre() const { return centre_; }
  float radius_m() const { return radius_m_; }

 private:
  enum class Shape { ellipsoid, cylinder, box };
  /// Upright; the box is turned about z. A cylinder has elliptic section half.x by half.y.
  struct Body {
    Shape shape;
    Eigen::Vector3f centre;
    Eigen::Vector3f half;
    float turn_cos;
    float turn_sin;
    Colour colour;
  };
  void add(Shape shape, const Eigen::Vector3f& offset, const Eigen::Vector3f& half, const Colour& colour);

  Eigen::Vector3f foot_ = Eigen::Vector3f::Zero();
  float turn_cos_ = 1.0F;
  float turn_sin_ = 0.0F;
  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();
  float radius_m_ = 0.0F;
  std::vector<Body> bodies_;
};

}  // namespace hogline::hw::sim
