// What a look at the house yields: the stones on the sheet, in the end's frame e, each with its diagnosis.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline {

/// Whose stone: the rig's first or second team. A colour that is neither, or that can not be told, is `unknown`.
enum class Team { first, second, unknown };

/// Covariance of a place in e: variances of x and y and what they share, m^2.
struct PlaceCovariance {
  double xx_m2 = 0.0;
  double xy_m2 = 0.0;
  double yy_m2 = 0.0;
};

/// One stone, standing on the ice.
struct StoneSighting {
  double x_m = 0.0;  ///< centre, in e
  double y_m = 0.0;
  PlaceCovariance covariance;
  Team team = Team::unknown;
  double team_confidence = 0.0;      ///< 0: could be anyone's, 1: no doubt; of `team`, or that it is unknown
  std::array<float, 3> colour{};     ///< of the handle against white ice: red, green, blue; about 0..1
  std::optional<double> handle_rad;  ///< the grip's direction from e's y axis, counter-clockwise, modulo half a turn;
                                     ///< empty: not measured
  double handle_sigma_rad = 0.0;     ///< of it
  double support = 0.0;              ///< share of the outline that could be seen and was found, 0..1
  double visible = 1.0;              ///< share of handle and body that no nearer stone hides, 0..1
  double residual = 0.0;             ///< RMS of what the model leaves, share of the contrast between stone and ice
};

/// Where a stone is thought to be when the picture is taken: a tracker's prediction.
struct StoneExpectation {
  double x_m = 0.0;  ///< centre, in e
  double y_m = 0.0;
  PlaceCovariance covariance;
};

/// The stones in view. `ok == false` means that nothing can be said, with the reason; an empty sheet is ok.
struct StonesPercept {
  bool ok = false;
  std::string reason;  ///< why not, when !ok; empty otherwise
  Stamp stamp{};       ///< middle of the exposure
  std::vector<StoneSighting> stones;
  int groups = 0;                 ///< boxes in which stones were looked for
  int candidates = 0;             ///< places that gathered enough votes
  int refused = 0;                ///< of those, how many turned out to be something else
  std::optional<double> blur_px;  ///< of painted edges, standard deviation; empty: not measured in this picture
  std::optional<double> noise;    ///< of a pixel's light against white ice, in its square root; empty: as blur_px
};

}  // namespace hogline
