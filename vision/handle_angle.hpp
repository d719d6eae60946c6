// The direction of a stone's handle, where its grip is seen.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vision/detect/stone_picture.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::vision {

/// `ok == false`: not measured, with the reason; nothing is guessed.
struct HandleAngle {
  bool ok = false;
  bool one_of_many = false;  ///< not to be believed by itself; of a stone that turns, together with its other looks
  std::string reason = {};
  double rad = 0.0;  ///< of the grip's bar from e's y axis, counter-clockwise, within half a turn about 0: it looks
                     ///< the same from both ends, and makers put the neck in different places
  double sigma_rad = 0.0;  ///< standard deviation
  double explained = 0.0;  ///< share of what is seen over the plate that a grip explains, 0..1
  double present = 1.0;    ///< at most so much of a grip is seen there, in any direction: 0 none, 1 all of it; 1 where
                           ///< that can not be told
  double visible = 0.0;    ///< share of the pixels that a grip may cover and that could be used, 0..1
};

/// Fits a level bar with a neck over the plate to the picture: against what is behind it where it stands out over the
/// rim, by its darker sides where it is seen before the plate. The stone's place must be good to a pixel or so and its
/// colour measured in this light; its team does not count. `others` are the places of stones near it (its own may be
/// among them), whose pixels are left out.
HandleAngle handle_angle(const StonePicture& picture, const StoneSighting& stone,
                         const std::vector<Eigen::Vector2d>& others = {});

/// The same into a sighting; what can not be measured is left empty.
void measure_handle(const StonePicture& picture, const std::vector<Eigen::Vector2d>& places, StoneSighting& stone);

/// Of a stone that turns: looks that only together are believed count, with twice their sigma.
void measure_turning_handle(const StonePicture& picture, const std::vector<Eigen::Vector2d>& places,
                            StoneSighting& stone);

}  // namespace hogline::vision
