#include "vision/near_sequence.hpp"

#include <cmath>

#include "vision/fit/sheet_track.hpp"
#include "vision/fit_percept.hpp"
#include "vision/near_view_sketch.hpp"
#include "vision/planar_motion.hpp"

namespace hogline::vision {
namespace {

constexpr double acquired_search_px = 3.0;

// How far a frame may be from its prediction: one standard deviation.
constexpr double unknown_yaw_rate_radps = 0.25;  // the alignment move turns at up to 0.35
constexpr double unknown_speed_mps = 0.5;
constexpr double yaw_acceleration_radps2 = 1.5;
constexpr double acceleration_mps2 = 2.0;
constexpr double lag_frames2 = 1.5;        // a parabola leaves the line through four frames by this much, in a * dt^2
constexpr double gyro_sigma_rad = 0.0004;  // its stamps and the camera's differ by a millisecond
constexpr double gyro_scale_sigma = 0.03;
constexpr double rock_rad = 0.001;  // of roll and pitch from frame to frame
constexpr double least_sigma_m = 0.001;
constexpr double height_sigma_m = 0.002;

}  // namespace

struct NearSequence::Impl {
  explicit Impl(const CameraSetup& camera_setup) : setup(camera_setup), view(camera_setup), track(camera_setup) {
    percept.features.reserve(20);
  }

  bool follow(const cv::Mat& image, Stamp stamp, std::optional<double> yaw_increment_rad);
  void acquire(const cv::Mat& image, Stamp stamp, NearViewSketch* sketch);
  enum class Trust { usual, little };
  SheetPrediction predict(Stamp stamp, std::optional<double> turned, Trust trust) const;
  void clear(Stamp stamp);

  CameraSetup setup;
  NearView view;
  SheetTrack track;
  PlanarMotion motion;                     // empty: nothing to track
  Pose eMc;                                // at the newest place of the motion
  std::optional<double> turned_rad = 0.0;  // by the gyro since then; nothing when it did not speak for every frame
  std::optional<Stamp> last_stamp;
  SheetPosePercept percept;
  NearSequenceDiagnosis diagnosis;
};

NearSequence::NearSequence(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
NearSequence::~NearSequence() = default;
NearSequence::NearSequence(NearSequence&&) noexcept = default;
NearSequence& NearSequence::operator=(NearSequence&&) noexcept = default;

const SheetPosePercept& NearSequence::step(const cv::Mat& image, Stamp stamp, std::optional<double> yaw_increment_rad,
                                           NearViewSketch* sketch) {
  impl_->clear(stamp);
  if (impl_->last_stamp && stamp <= *impl_->last_stamp) {
    impl_->percept.reason = "the frame is not newer than the one before";
    return impl_->percept;
  }
  impl_->last_stamp = stamp;

  if (!impl_->follow(image, stamp, yaw_increment_rad)) {
    impl_->acquire(image, stamp, sketch);
  } else if (sketch != nullptr) {
    draw_model(impl_->eMc, impl_->setup, impl_->percept.sheet_width_m, *sketch);
  }
  return impl_->percept;
}

const NearSequenceDiagnosis& NearSequence::diagnosis() const { return impl_->diagnosis; }

void NearSequence::Impl::clear(Stamp stamp) {
  percept.ok = false;
  percept.reason.clear();
  percept.stamp = stamp;
  percept.features.clear();
  diagnosis.tracked = false;
  diagnosis.lost.clear();
  diagnosis.places = diagnosis.moved = 0;
  diagnosis.search_px = diagnosis.innovation = 0.0;
}

// False: lost, with the reason in the diagnosis.
bool NearSequence::Impl::follow(const cv::Mat& image, Stamp stamp, std::optional<double> yaw_increment_rad) {
  if (motion.empty()) {
    diagnosis.lost = "no frame before shows the sheet";
    return false;
  }
  turned_rad = turned_rad && yaw_increment_rad ? std::optional(*turned_rad + *yaw_increment_rad) : std::nullopt;
  if (seconds(stamp - motion.last_stamp()) > longest_gap_s) {
    diagnosis.lost = "the frames before are too old";
    return false;
  }
  if (!track.follow(image, predict(stamp, turned_rad, Trust::usual)).ok) {
    // A jerk, or a gyro that errs: a wide search costs a twentieth of an acquisition.
    track.follow(image, predict(stamp, std::nullopt, Trust::little));
  }
  diagnosis.places = track.diagnosis().places;
  diagnosis.moved = track.diagnosis().moved;
  diagnosis.search_px = track.diagnosis().search_px;
  diagnosis.innovation = track.diagnosis().innovation;
  const SheetFitResult& result = track.result();
  if (!result.ok) {
    diagnosis.lost = result.reason;
    return false;
  }
  percept.features.emplace_back("tracked");
  fill_percept(result, percept);
  motion.add(stamp, result.body);
  eMc = result.eMc;
  turned_rad = 0.0;
  diagnosis.tracked = true;
  ++diagnosis.frames_tracked;
  return true;
}

void NearSequence::Impl::acquire(const cv::Mat& image, Stamp stamp, NearViewSketch* sketch) {
  diagnosis.frames_tracked = 0;
  percept = view.acquire(image, stamp, sketch);
  if (!percept.ok) return;
  percept.features.insert(percept.features.begin(), "acquired");
  motion.clear();
  SheetFitStart start;
  start.eMc = from_row_major(percept.eMc);
  start.search_px = acquired_search_px;
  if (!track.begin(image, start).ok) return;
  motion.add(stamp, percept.body);
  eMc = start.eMc;
  turned_rad = 0.0;
}

// The camera as it was in the newest place, moved with the body; the rest is what a body can do in a frame.
SheetPrediction NearSequence::Impl::predict(Stamp stamp, std::optional<double> turned, Trust trust) const {
  const bool known = motion.known() && trust == Trust::usual;
  const double dt_s = seconds(stamp - motion.last_stamp());
  PlanarPose body = motion.at(stamp);
  double yaw_sigma_rad = known ? lag_frames2 * yaw_acceleration_radps2 * dt_s * dt_s : unknown_yaw_rate_radps * dt_s;
  if (turned) {
    body.yaw_rad = motion.last().yaw_rad + *turned;
    yaw_sigma_rad = std::hypot(gyro_sigma_rad, gyro_scale_sigma * *turned);
  }
  const double place_sigma_m =
      least_sigma_m + (known ? lag_frames2 * acceleration_mps2 * dt_s * dt_s : unknown_speed_mps * dt_s);

  SheetPrediction prediction;
  prediction.eMc = eMb(body) * eMb(motion.last()).inverse() * eMc;
  const Eigen::Matrix3d eRc = prediction.eMc.linear();
  const Eigen::Vector3d place(place_sigma_m, place_sigma_m, height_sigma_m);
  const Eigen::Vector3d turn(rock_rad, rock_rad, yaw_sigma_rad);
  prediction.covariance.setZero();
  prediction.covariance.topLeftCorner<3, 3>() = eRc.transpose() * place.cwiseAbs2().asDiagonal() * eRc;
  prediction.covariance.bottomRightCorner<3, 3>() = eRc.transpose() * turn.cwiseAbs2().asDiagonal() * eRc;
  prediction.travel.setZero();
  return prediction;
}

}  // namespace hogline::vision
