// Scenes nobody has chosen: the near camera of a robot that stands anywhere before its house, on a sheet of any of the
// clubs' colours and dividers, with stones and people anywhere. Rendered by hw/sim, with exact truth.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "hw/sim/appearance.hpp"
#include "hw/sim/sheet_renderer.hpp"
#include "vision/camera_setup.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::testing {

/// How crowded and how rough it may be.
struct SceneMix {
  int most_stones = 8;
  int most_people = 2;
  bool colour_mosaic = true;  ///< the sensor has one colour a pixel (Bayer), interpolated bilinearly
  int jpeg_quality = 95;      ///< 0: not compressed
  double most_tilt_rad = 0.004;
};

struct RandomScene {
  std::uint64_t seed = 0;
  vision::CameraSetup setup;  ///< as a rig file would give it: mount as calibrated, nominal width
  vision::Mount true_mount;
  PlanarPose body;
  vision::Pose eMc;
  double sheet_width_m = 0.0;
  hw::sim::RinkAppearance rink;
  hw::sim::SensorModel sensor;
  hw::sim::Exposure exposure;
  std::string what;  ///< in words, for messages
};

/// The same seed and mix give the same scene.
RandomScene random_scene(std::uint64_t seed, const SceneMix& mix = {});

/// Its picture (CV_8UC3), about 40 ms.
cv::Mat render(const RandomScene& scene, const SceneMix& mix = {});

}  // namespace hogline::testing
