// What the methods are shown: pictures in their order, with exact truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/method.hpp"
#include "vision/camera_setup.hpp"

namespace hogline::bench {

struct Shot {
  Frame frame;
  PlanarPose body;   ///< true
  vision::Pose eMc;  ///< true
};

/// One camera, one robot, any number of frames.
struct Footage {
  std::string name;
  vision::CameraSetup setup;   ///< as a rig file would give it
  double sheet_width_m = 0.0;  ///< true, between the sidelines' inner edges
  bool sidelines = true;       ///< there is a painted or raised sideline on both sides
  int frames = 0;
  int first_counted = 0;  ///< frames before are for trackers to settle and for memory to be allocated
  std::function<Shot(int)> shot;
};

/// Every NAME.jpg with its NAME.json in a folder, each as footage of a camera that stands still: the same picture five
/// times, of which the last three count. Throws std::runtime_error when a scene can not be read or there is none.
std::vector<Footage> scenes_in(const std::string& folder);

/// The alignment move before the near camera: 10 degrees at up to 20 deg/s, 60 Hz; `people` walk through the view.
Footage turning(bool people);

/// A run towards the hog line as the low camera sees it, from 2.5 m to where the line leaves the picture; 60 Hz.
/// `accelerating` and rocking harder, on another sheet.
Footage running(bool accelerating);

/// The same footage, cut short.
Footage first_frames(Footage footage, int frames);

}  // namespace hogline::bench
