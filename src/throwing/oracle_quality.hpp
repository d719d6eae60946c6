// How well the cameras see, in numbers that were measured: what the oracle adds to the truth.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hogline {

/// The errors of one coordinate at one distance, as standard deviations but for the offset.
struct SightError {
  double offset = 0.0;   ///< common to all throws
  double bias = 0.0;     ///< constant in a throw: ice thicker than assumed, a mount that is slightly off
  double drift = 0.0;    ///< correlated from frame to frame
  double noise = 0.0;    ///< independent from frame to frame
  double claimed = 0.0;  ///< what the percept says its standard deviation is
};

/// What is seen at one distance to the hog line; in between, what lies between two.
struct SightKnot {
  double hog_m = 0.0;
  double missing_share = 0.0;  ///< of the frames that show nothing
  SightError x;                ///< metres
  SightError y;                ///< metres
  SightError yaw;              ///< radians
};

struct SightQuality {
  double drift_time_s = 0.0;     ///< in which drifts are forgotten
  double missing_frames = 1.0;   ///< how many in a row show nothing, in the mean
  std::vector<SightKnot> knots;  ///< by growing distance; beyond the outer ones nothing is seen
};

struct OracleQuality {
  SightQuality near;
  SightQuality low;
};

/// Throws ConfigError. `name` stands in messages.
OracleQuality parse_oracle(std::string_view text, const std::string& name);

/// The same as a file's text; `about` becomes its first comment lines.
std::string oracle_text(const OracleQuality& quality, const std::string& about);

/// What was measured last (config/oracles/measured.yaml).
OracleQuality measured_quality();

}  // namespace hogline
