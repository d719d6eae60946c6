// A recorded throw: a folder with near.csv and far.csv (name,id,time_s, a line a picture; doc/cameras.md) and head.csv
// (time_s,pan_deg,tilt_deg). One of the two cameras may be missing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hw/files/recording.hpp"
#include "servo/head_kinematics.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

struct HeadRow {
  Duration time{};
  servo::HeadAngles angles;
};

struct SkipRecording {
  hw::files::Recording near;  ///< empty where there is none
  hw::files::Recording far;
  std::vector<HeadRow> head;
};

/// Throws ConfigError, naming file, line and what is wrong.
SkipRecording read_skip_recording(const std::string& folder);

/// Between the rows; nothing more than 50 ms before the first or after the last.
std::optional<servo::HeadAngles> angles_at(const SkipRecording& recording, Duration time);

/// Hands every frame on to another seer, and writes it down. Throws std::runtime_error when it can not.
class RecordingSeer final : public SkipSeer {
 public:
  /// The seer must outlive it; the folder is there.
  RecordingSeer(SkipSeer& seer, const std::string& folder);
  ~RecordingSeer() override;

  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override;
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override;

 private:
  struct Files;
  std::unique_ptr<Files> files_;
  SkipSeer& seer_;
};

}  // namespace hogline
