// What a camera sees of the simulated rink: one ray per pixel from the lens, to the surface of the ice, refracted to
// the paint (Snell), whose edges are drawn by the share of the pixel's footprint that they cover.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "hw/sim/appearance.hpp"
#include "vision/geometry/ice.hpp"
#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::hw::sim {

/// One exposure.
struct Exposure {
  vision::Pose eMc;               ///< in the middle of it
  vision::Twist velocity;         ///< of the camera: of its origin in e, and its rate of turn about e's axes
  double duration_s = 0.0;        ///< 0: no motion blur
  std::vector<StoneLook> stones;  ///< where they are now; they are drawn sharp
  std::vector<PersonLook> people;
};

/// Edges of paint lie within 0.02 px of vision's exact projection (tested). The same exposure and seed give the same
/// bytes, whatever the number of threads. Not for use by several threads at once.
class SheetRenderer {
 public:
  /// `seed` chooses the sensor's table of noise. Precondition: positive size, focal lengths and gamma; 1 or more
  /// threads.
  SheetRenderer(const vision::Intrinsics& intrinsics, const vision::Ice& ice, const RinkAppearance& rink,
                const SensorModel& sensor, std::uint64_t seed, int threads = 1);
  ~SheetRenderer();
  SheetRenderer(SheetRenderer&&) noexcept;
  SheetRenderer& operator=(SheetRenderer&&) noexcept;

  /// The picture as CV_8UC3 (BGR) in the sensor's response curve; `bgr` is allocated where it does not fit. The noise
  /// depends on `frame_seed` alone. Precondition: a finite pose above the surface and between the boards.
  void render(const Exposure& exposure, std::uint64_t frame_seed, cv::Mat& bgr) const;

  /// A covered lens: the same little light, 1 at full scale, on every pixel, with the sensor's noise.
  void render_darkness(double light, std::uint64_t frame_seed, cv::Mat& bgr) const;

  /// The light before noise, response curve and rounding, as CV_32FC3 (BGR), 1 at full scale.
  void render_light(const Exposure& exposure, cv::Mat& bgr) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::hw::sim
