// How one GenICam camera is set. No defaults where the rig file must decide.
#pragma once

#include <optional>
#include <string>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// What the camera's own stamps mean (its manual says so), or that they are not used.
enum class CameraStampMeaning { not_used, exposure_start, exposure_end };

struct AravisConfig {
  std::string name;     ///< "near camera": stands in errors
  std::string serial;   ///< as printed on the camera
  std::string address;  ///< IP address: opened there without looking for it; empty: looked for by its serial number
  int width_px = 0;     ///< what the rig says; a camera that gives another size is refused, never scaled
  int height_px = 0;
  std::optional<int> offset_x_px;  ///< together: the region of the sensor is set to width x height from there;
  std::optional<int> offset_y_px;  ///< without them it stays as it is in the camera
  std::string pixel_format;        ///< GenICam name: Mono8, BGR8, RGB8, BayerRG8, ...
  double exposure_s = 0.0;
  std::optional<double> gain_db;
  double frame_rate_hz = 0.0;
  int packet_size_bytes = 0;  ///< GigE: 0 leaves it as it is; jumbo frames need the network card's MTU
  CameraStampMeaning stamp = CameraStampMeaning::not_used;
  Duration latency{};            ///< from the end of the exposure to the first packet's arrival, at its quickest
  Duration first_frame_limit{};  ///< after the start of the acquisition; then it is started anew
  Duration silence_limit{};      ///< the longest time without a complete frame
  Duration retry_delay{};        ///< between two attempts to open the camera
};

}  // namespace hogline::hw
