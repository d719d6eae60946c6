// Where paint should be seen, given where the camera is thought to be.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/fit/fit_parameters.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// A place on an edge (or on a thin line's middle) and what its pixel does when the parameters change.
struct PlannedSite {
  int feature = 0;
  double place = 0.0;          ///< on the feature: angle of a ring, x of a line across, y of a line along
  int stretch = 0;             ///< number of the piece of the feature it lies on: neighbours share errors
  bool step = true;            ///< an edge; false: a line with both its edges, located as one
  int sense = 0;               ///< of an edge: 1 or -1, its colours change as the feature's do or the other way; 0: any
  Eigen::Vector2d pixel;       ///< predicted
  Eigen::Vector2d normal;      ///< unit, in the picture
  ParameterRow along;          ///< d(normal . pixel)/d(parameters)
  double width_px = 0.0;       ///< of the line between its edges; 0 for a step
  double blur_px = 1.0;        ///< expected, standard deviation
  double curvature = 0.0;      ///< the curve leaves its tangent by curvature / 2 * t^2 along the normal, 1/px
  double floor_px = 0.05;      ///< error of paint, lens and model at one site, beside noise
  double search_px = 0.0;      ///< how far from the prediction a wide look goes
  double before_px = 0.0;      ///< room without other paint before the (first) edge ...
  double after_px = 0.0;       ///< ... and after the (second) one
  double seen_blur_px = 0.0;   ///< when it was measured last; 0: never
  double seen_contrast = 0.0;  ///< when moving edges saw it last, see MovingEdge; 0: never
  int borne_out = 0;           ///< when it was looked for last: 1 the fit rested on it, -1 not; 0: never looked for
};

struct SitePlan {
  double spacing_px = 10.0;
  double optical_blur_px = 1.0;  ///< standard deviation of lens, sensor and demosaicing together
  double travel_m = 0.0;         ///< of the camera along y during the exposure
  double half_width_m = 2.1;     ///< lines across are looked for within this of the centre line
  int only_feature = -1;         ///< plan this one alone; -1: all
};

/// Appends nothing outside the picture or the lens, nothing hidden in other paint's blur, nothing too thin to see.
void plan_sites(const SheetCamera& camera, const FitState& state, const SitePlan& plan,
                std::vector<PlannedSite>& sites);

/// The cameras that see paint through the ice, and what stands on the ice.
struct SiteCameras {
  SiteCameras(const Lens& lens, const Pose& eMc, const Ice& ice) : paint(lens, eMc, ice), surface(lens, eMc, {}) {}
  void move_to(const Pose& eMc);

  SheetCamera paint;
  SheetCamera surface;
};

/// A planned site as another pose or state sees it: its pixel, normal, width and derivatives; what changes slowly
/// (room, curvature, blur) stays. False when the cut that measures it leaves the picture, or when it has become too
/// thin; the site is then unchanged.
bool reproject(const SiteCameras& cameras, const FitState& state, PlannedSite& site);

}  // namespace hogline::vision
