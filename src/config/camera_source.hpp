// Where a camera's pictures come from: the source section of the rig file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "hw/aravis/aravis_config.hpp"
#include "src/config/strict_yaml.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::config {

struct SimulatedSource {};

/// Either `stamps`, or `path` and `rate_hz`.
struct FolderSource {
  std::string path;
  double rate_hz = 0.0;
  std::string stamps;
};

struct VideoSource {
  std::string path;
  double rate_hz = 0.0;  ///< 0: the file's own
};

/// Pictures that another program of this machine writes into shared memory.
struct SharedMemorySource {
  std::string segment;
};

/// The limits of a section that is left out are those of the practice rig.
struct CameraSource {
  std::variant<SimulatedSource, hw::AravisConfig, FolderSource, VideoSource, SharedMemorySource> device;
  Duration max_age = std::chrono::milliseconds(100);        ///< of a frame when it is given
  Duration silence_limit = std::chrono::milliseconds(150);  ///< the longest time without a frame
};

/// The camera's section has passed the schema and holds a source. Throws ConfigError where the schema can not say it:
/// not exactly one kind of source, half a region, half a folder.
CameraSource read_camera_source(const std::string& name, const nlohmann::json& camera, const Document& document);

}  // namespace hogline::config
