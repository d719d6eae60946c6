// A camera whose frames can be used: stands between any adapter and the one who looks at its pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hw/camera.hpp"
#include "vision/picture/picture_check.hpp"

namespace hogline::hw {

struct CameraWatch {
  std::string name;          ///< "low camera": stands in errors
  Duration max_age{};        ///< from the middle of the exposure until the frame is given
  Duration silence_limit{};  ///< the longest time without a frame while frames are asked for
  Duration first_frame_limit = std::chrono::seconds(10);  ///< the same before the first frame of all
  vision::PictureLimits picture{};
};

/// Since construction.
struct CheckedCameraCounters {
  std::uint64_t given = 0;
  std::uint64_t refused = 0;   ///< failed a check
  std::uint64_t too_soon = 0;  ///< exposed before anybody asked, or waited for somebody to: see CheckedCamera
};

/// Gives the frames of another camera that pass, and latches a device error with the first that does not: late, from
/// the future, its stamp or number not after the last one's, black, saturated or frozen. Such a frame is not given.
/// Silence is an error as well: while frames are asked for, one must come within the limit.
///
/// After a pause in the asking (longer than silence_limit), frames exposed before the asking began again are passed
/// over: whoever asks decides when the camera has something to see, and a folded head sees darkness. After a shorter
/// one a frame that has become too old only because nobody asked is passed over as well.
class CheckedCamera final : public Camera {
 public:
  /// The camera must outlive this.
  CheckedCamera(Camera& camera, CameraWatch watch);

  std::optional<Frame> latest(Stamp now) override;
  /// The latched error of a check, or the camera's own.
  std::optional<DeviceError> error() const override;
  /// The camera's own error too. The next frame has no predecessor.
  void rearm() override;

  const CheckedCameraCounters& counters() const { return counters_; }
  /// Of the last picture looked at.
  const std::optional<vision::PictureVerdict>& verdict() const { return verdict_; }

 private:
  struct Problem {
    DeviceErrorKind kind;
    std::string what;
  };
  void note_asking(Stamp now);
  void watch_silence(Stamp now);
  std::optional<Problem> problem_of(const Frame& frame, Stamp now);
  void fail(Problem problem, Stamp now);

  Camera& camera_;
  CameraWatch watch_;
  vision::PictureCheck check_;
  std::optional<Stamp> last_asked_;
  Stamp asking_since_{};
  Stamp last_frame_{};  ///< when one arrived here, or the asking began
  bool ever_ = false;
  std::optional<Stamp> newest_stamp_;
  std::uint64_t newest_id_ = 0;
  std::optional<vision::PictureVerdict> verdict_;
  std::optional<DeviceError> error_;
  CheckedCameraCounters counters_;
};

}  // namespace hogline::hw
