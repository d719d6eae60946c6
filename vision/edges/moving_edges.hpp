// Moving edges (Bouthemy 1989) by ViSP's oriented masks: where an edge or a thin line has gone since the last frame,
// along its normal and to the pixel. Reads only the few pixels about each site.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "vision/edges/profile.hpp"

namespace hogline::vision {

/// One site as it is expected in the new frame.
struct MovingEdge {
  Eigen::Vector2d pixel;                          ///< predicted; pixel centres at integers
  Eigen::Vector2d normal;                         ///< unit
  double width_px = -1.0;                         ///< of a thin line between its edges; below 0: one edge
  int range_px = 6;                               ///< the search reaches this far either way, at most max_range_px
  double contrast = 0.0;                          ///< when last found, in grey levels along the normal; 0: not known
  std::array<float, 3> colour{1.0F, 1.0F, 1.0F};  ///< what of each channel makes the grey that is searched
};

/// Where it went.
struct MovedEdge {
  bool found = false;
  double offset_px = 0.0;  ///< from the prediction along the normal, to about half a pixel
  double contrast =
      0.0;  ///< grey levels along the normal: positive where it grows brighter; a line's is its first edge's
};

/// ViSP's search with two differences. vpMeSite::track() starts at the truncated pixel and reports the one asked for
/// (up to a pixel of bias); here the place reported is the pixel whose mask answered. And it allocates for each site;
/// here nothing is. The choice among the answers is ViSP's: of those above the threshold, the one whose contrast is
/// most like the remembered one within the tolerance; without memory the strongest.
class MovingEdges {
 public:
  /// `least_contrast`: weaker edges are noise, in grey levels.
  explicit MovingEdges(double least_contrast = 8.0);
  ~MovingEdges();
  MovingEdges(MovingEdges&&) noexcept;
  MovingEdges& operator=(MovingEdges&&) noexcept;

  /// Not found when the search leaves the picture or nothing like it is there. Precondition: 1 or 3 channels.
  MovedEdge follow(const Picture& picture, const MovingEdge& edge) const;

  static constexpr int max_range_px = 16;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
