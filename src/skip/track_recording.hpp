// A recorded throw followed by the skip's own controller: what it would have said, had it stood there.
#pragma once

#include <functional>

#include "hw/camera.hpp"
#include "servo/skip.hpp"
#include "src/skip/skip_recording.hpp"

namespace hogline {

/// Loads one picture; an empty one where it can not be read.
using FrameLoader = std::function<hw::Frame(const hw::files::RecordedFrame&)>;

struct TrackedThrow {
  servo::SkipReport report;
  servo::SkipDiagnosis known;
  std::optional<servo::StopPrediction> foretold;  ///< the last one before the near hog line
  Stamp origin{};                                 ///< of the release where it was recorded, else of the first picture
  int near_frames = 0;
  int far_frames = 0;
  int unread = 0;  ///< of these, how many could not be loaded
};

/// `config` as for the live skip; ages of cameras that the recording does not have are not asked for. Deterministic.
TrackedThrow track_recording(const SkipRecording& recording, servo::SkipConfig config, const servo::IceEstimate& ice,
                             SkipSeer& seer, const FrameLoader& load);

}  // namespace hogline
