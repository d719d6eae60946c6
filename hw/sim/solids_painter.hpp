// Lays the hall, stones and people into the tiles of a picture.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hw/sim/ice_tile.hpp"
#include "hw/sim/light_field.hpp"
#include "hw/sim/ray_table.hpp"
#include "hw/sim/solids.hpp"
#include "hw/sim/strip.hpp"

namespace hogline::hw::sim {

/// A cone of directions in c.
struct Cone {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
  float cosine = 1.0F;  ///< of its half angle
  float sine = 0.0F;
  bool meets(const Cone& other) const { return axis.dot(other.axis) >= cosine * other.cosine - sine * other.sine; }
};

/// A stone or person and the cone in which the camera sees it.
struct SeenSolid {
  Solid solid;
  Cone cone;
};

class SolidsPainter {
 public:
  /// The references are kept.
  SolidsPainter(const Hall& hall, const RayTable& rays, const LightField& field);

  /// Those of the solids that may be seen in tile (i, j).
  void choose(const std::vector<SeenSolid>& solids, int i, int j, std::vector<const Solid*>& near) const;

  /// A tile of one wall only: true, and it is laid. False: something ends in it, and nothing is laid.
  bool lay_plain_hall(const IceView& view, int i, int j, Strip& strip) const;

  /// The solids, and the hall where asked for, over what is there already. Drawn by rays between the pixels, each pixel
  /// the mean of its four.
  void lay(const IceView& view, int i, int j, const std::vector<const Solid*>& near, bool with_hall,
           Strip& strip) const;

 private:
  Eigen::Vector3f corner_ray(int i, int j) const;

  const Hall& hall_;
  const RayTable& rays_;
  const LightField& field_;
  std::vector<Cone> cones_;  ///< of the tiles
};

/// As a camera at `eye` sees it that turns e's directions into c by cRe.
SeenSolid seen_from(const Solid& solid, const Eigen::Vector3f& eye, const Eigen::Matrix3f& cRe);

}  // namespace hogline::hw::sim
