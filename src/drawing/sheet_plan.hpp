// The sheet from above, as curlers draw it: the throw goes to the right in a wide picture, or up in a tall one.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/drawing/canvas.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::drawing {

/// A stone seen from above: a disc of granite with the team's handle.
struct PlanStone {
  Eigen::Vector2d place_m{0.0, 0.0};      ///< in e
  std::optional<double> handle_rad{0.0};  ///< the handle's bar, from e's y axis, counter-clockwise; empty: not drawn
  Ink team = inks::red;
  std::string label;
  bool ringed = false;  ///< the thrown one
};

/// A line on the ice with a name: the robot's path, the stone's track, the shot's line.
struct PlanTrack {
  std::string name;
  std::vector<Eigen::Vector2d> points_m;  ///< in e; what is not finite makes a gap
  Ink ink = inks::blue;
  bool dashed = false;
};

/// A place with a name: where the stone was let go.
struct PlanMark {
  std::string name;
  Eigen::Vector2d place_m{0.0, 0.0};
  Ink ink = inks::text;
};

/// Where something is, with its one-sigma ellipse.
struct PlanEllipse {
  Eigen::Vector2d place_m{0.0, 0.0};
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();  ///< in e
  double sigmas = 2.0;                                      ///< how many of them are drawn
  Ink ink = inks::purple;
};

enum class ThrowDirection { right, up };

struct SheetPlan {
  std::string title;
  double width_m = vision::rules::nominal_width_m;
  std::array<Ink, 4> rings{{{70, 110, 190}, {250, 251, 252}, {205, 75, 65}, {250, 251, 252}}};  ///< outermost first
  ThrowDirection direction = ThrowDirection::right;
  double from_y_m = -5.5;  ///< what is shown, in e
  double to_y_m = 40.5;
  std::vector<PlanTrack> tracks;
  std::vector<PlanStone> stones;
  std::vector<PlanEllipse> ellipses;
  std::vector<PlanMark> marks;
};

/// The plan in a picture `length_px` long in the direction of the throw; its other side follows from the sheet's width.
cv::Mat draw_sheet_plan(const SheetPlan& plan, int length_px);

}  // namespace hogline::drawing
