// The joint refinement of stones' places: every pixel about the outlines of handle and body is explained as a mixture
// of the handle's colour, granite and what is behind; Gauss-Newton on all places, with the shape that all stones share
// (the handle's thickness, the body's radius and height) found along with them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vision/fit/foreground.hpp"
#include "vision/fit/stone_model.hpp"

namespace hogline::vision {

/// How a stone came out.
struct FittedStone {
  bool ok = false;
  std::string reason = {};  ///< why not, when !ok
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the place, the shared shape's doubt included
  Light handle = Light::Zero();                          ///< colour against white ice: blue, green, red
  Light granite = Light::Zero();
  int granite_pixels = 0;  ///< of those used, how many show granite and nothing else
  double residual = 0.0;   ///< RMS of light left unexplained, against white ice
  double explained = 0.0;  ///< share of the picture's difference from the background that the stone explains, 0..1
  double handle_contrast = 0.0;  ///< between handle and granite, in light against white ice
  double body_contrast = 0.0;    ///< between granite and what is behind it
  int telling = 0;               ///< pixels that the stone changes clearly, and that no nearer stone's grip may cover
  double told = 0.0;             ///< share of them that are as the stone would have them, 0..1; no pixel is forgiven
  int handle_told = 0;           ///< pixels of the handle that are as it would have them
  int granite_told = 0;
  double visible = 0.0;  ///< share of the outline that nothing nearer hides
};

struct StoneFitResult {
  std::vector<FittedStone> stones;  ///< as many as were given, in their order
  SharedLook look;                  ///< as refined
};

struct StoneFitOptions {
  int iterations = 4;
  bool fit_shape = true;
  bool give_up_hopeless = false;              ///< where nothing like a stone is seen at the start, no step is taken
  bool covariance = true;                     ///< else that of what the shape leaves open is left out
  int pixels = 240;                           ///< about so many of each stone
  std::vector<KnownStone> nearer = {};        ///< stones known already, which may hide parts of these
  std::optional<SharedLook> begin_with = {};  ///< what the last picture showed of it; empty: the rig's shape
};

/// Where a stone may stand, and the club's granite where it is known: of what is half hidden it can not be learnt.
struct StoneStart {
  Eigen::Vector2d place;
  std::optional<Light> granite = {};
  const Foreground* before = nullptr;  ///< what somebody hides of it, where that is known; used by begin()
};

/// Keeps its memory from fit to fit.
class StoneFitter {
 public:
  /// Takes up stones at `starts`, within about a pixel and a half of the truth, and finds their colours there. The
  /// picture is used until the next begin().
  void begin(const StonePicture& picture, const std::vector<StoneStart>& starts, const StoneFitOptions& options);

  /// The first stone's granite before any step: blue, green, red against white ice.
  Light first_granite() const;

  /// Takes the steps. As many stones as were given, in their order.
  const StoneFitResult& run();

 private:
  void settle_surroundings();
  bool all_hopeless();  ///< concludes where they stand
  void conclude();
  void step(bool with_shared);
  SharedMatrix shared_normal(bool with_stones) const;
  SharedVector shared_step() const;

  StoneFitOptions options_;
  SharedLook look_;
  SharedVector prior_;
  std::vector<StoneModel> stones_;
  StoneFitResult result_;
};

}  // namespace hogline::vision
