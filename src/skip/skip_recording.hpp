// A recorded throw: a folder with near.csv and far.csv (name,id,time_s, a line a picture; doc/cameras.md), head.csv
// (time_s,pan_deg,tilt_deg), and release.csv where the thrower told when it let go (one line; the fields are
// ReleaseSignal's). One of the two cameras may be missing.
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

/// What the thrower told, and when it was heard.
struct RecordedRelease {
  Duration heard{};
  servo::ReleaseSignal signal;  ///< its stamp counts from the epoch, as the recording's times do from their zero
};

struct SkipRecording {
  hw::files::Recording near;  ///< empty where there is none
  hw::files::Recording far;
  std::vector<HeadRow> head;
  std::optional<RecordedRelease> release{};
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

  /// What the thrower told.
  void hear(const servo::ReleaseSignal& signal, Stamp now);

  servo::NearSight near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                             const servo::SkipDiagnosis& known) override;
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles& q, const servo::SkipDiagnosis& known) override;

 private:
  struct Files;
  std::unique_ptr<Files> files_;
  SkipSeer& seer_;
};

}  // namespace hogline
