// Cuts through a painted line where a pose puts it, and what each of them shows: the line, bare ice, or something that
// hides it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/edges/profile.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// A place on a line: on its first edge, from there to the second one, and along the line. In e, metres; `along` unit.
struct LinePlace {
  Eigen::Vector2d first_edge;
  Eigen::Vector2d across;
  Eigen::Vector2d along;
};

/// What a cut shows, in linear light.
struct LineCut {
  Eigen::Vector3f ice = Eigen::Vector3f::Zero();    ///< beside the line
  Eigen::Vector3f paint = Eigen::Vector3f::Zero();  ///< in its middle, less the ice
  float sides = 0.0F;                               ///< how far the two sides differ
  /// Outside and inside the first edge, inside and outside the second, less the ice; only of a wide line.
  Eigen::Matrix<float, 3, 4> edges = Eigen::Matrix<float, 3, 4>::Zero();
  bool wide = false;  ///< in the picture: its two edges are seen each for itself
};

class LineCutter {
 public:
  LineCutter(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera)
      : picture_(picture), response_(response), camera_(camera) {}

  /// Nothing where the picture does not show the line with its sides.
  std::optional<LineCut> cut(const LinePlace& place) const;
  /// A mean over a few pixels beside each other along `tangent`; nothing outside the picture.
  std::optional<Eigen::Vector3f> light_at(const Eigen::Vector2d& pixel, const Eigen::Vector2d& tangent) const;

  const SheetCamera& camera() const { return camera_; }

 private:
  const Picture& picture_;
  const ResponseCurve& response_;
  const SheetCamera& camera_;
};

enum class LineLook {
  line,    ///< paint of the line's colour between ice on either side; a wide line with both its edges
  bare,    ///< nothing but ice
  hidden,  ///< something else
};

/// One look per cut: the line's colour and the ice's are what most cuts show. Empty when no cut shows any paint.
std::vector<LineLook> looks_of(const std::vector<LineCut>& cuts);

}  // namespace hogline::vision
