#include "vision/low_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "vision/fit/paint.hpp"
#include "vision/fit/sheet_track.hpp"
#include "vision/geometry/sheet_camera.hpp"
#include "vision/low_percept.hpp"
#include "vision/low_view_sketch.hpp"
#include "vision/near_view_sketch.hpp"
#include "vision/run_motion.hpp"

namespace hogline::vision {
namespace {

constexpr std::size_t most_features = 20;
constexpr double acquired_search_px = 3.0;
constexpr double any_sigma_m = 1e6;     // the tracker goes on where the distance can not be told
constexpr double most_sigma_m = 0.3;    // of what is reported as seen
constexpr double most_across_m = 0.05;  // of the place across the sheet, beside a dead-reckoned distance
constexpr double rock_rad = 0.002;      // of pitch, from frame to frame
constexpr double standing_px = 1.0;     // a picture that has moved by less shows nothing new of the pitch
constexpr double roll_rad = 0.0005;
constexpr double heave_m = 0.001;
constexpr double least_sigma_m = 0.001;
constexpr double least_sigma_rad = 0.0003;
constexpr int fewest_hog_places = 12;
constexpr double least_hog_share = 0.3;
constexpr int fewest_sideline_places = 6;

ChoiceWishes wishes() {
  const auto& features = paint_features();
  const auto hog =
      std::find_if(features.begin(), features.end(), [](const PaintFeature& f) { return f.name == "hog_line"; });
  return {.certain_feature = static_cast<int>(hog - features.begin()),
          .certain_places = 24,
          .least_places = 12,
          .avoid_hidden = true};
}

const FittedFeature* hog_line_of(const SheetFitResult& result) {
  const auto f = std::find_if(result.features.begin(), result.features.end(),
                              [](const FittedFeature& feature) { return feature.name == "hog_line"; });
  return f == result.features.end() ? nullptr : &*f;
}

/// Of both sidelines together.
struct SidelineSites {
  int tried = 0;
  int used = 0;
};

SidelineSites sidelines_of(const SheetFitResult& result) {
  SidelineSites sites;
  for (const FittedFeature& f : result.features) {
    if (f.name != "left_sideline" && f.name != "right_sideline") continue;
    sites.tried += f.sites_tried;
    sites.used += f.sites_used;
  }
  return sites;
}

}  // namespace

struct LowSequence::Impl {
  Impl(const CameraSetup& camera_setup, double exposure)
      : setup(camera_setup), lens(camera_setup.intrinsics), exposure_s(exposure), view(setup), track(setup, wishes()) {
    percept.features.reserve(most_features);
  }

  void clear(Stamp stamp);
  bool follow(const cv::Mat& image, Stamp stamp);
  const SheetFitResult& follow_at_any_speed(const cv::Mat& image, Stamp stamp);
  bool take(const SheetFitResult& result, Stamp stamp);
  bool hog_line_seen(const SheetFitResult& result) const;
  bool sidelines_left_behind(const SheetFitResult& result) const;
  bool take_blind(const SheetFitResult& result, Stamp stamp);
  void acquire(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch);
  bool dead_reckon(const cv::Mat& image, Stamp stamp);
  SheetFitStart track_start(const Pose& near_by) const;
  void forget();
  void remember_pitch();
  SheetPrediction predict_camera(Stamp stamp) const;
  LowViewPrediction predict_body(Stamp stamp) const;
  bool hog_line_below(const PlanarPose& body) const;
  RunPlace place(Stamp stamp) const;
  bool give_up(std::string why);

  CameraSetup setup;
  Lens lens;
  double exposure_s;
  LowView view;
  SheetTrack track;
  RunMotion along;   // of frames that show the hog line
  RunMotion across;  // of all that were measured
  Pose eMc;          // at the newest place
  PlanarPose body;   // there
  bool tracking = false;
  bool by_sidelines = false;  // the newest place rests on them, too
  std::optional<PitchMemory> pitch;
  std::optional<double> width_m;
  std::optional<Stamp> last_stamp;
  SheetPosePercept percept;
  LowSequenceDiagnosis diagnosis;
};

LowSequence::LowSequence(const CameraSetup& setup, double exposure_s)
    : impl_(std::make_unique<Impl>(setup, exposure_s)) {}
LowSequence::~LowSequence() = default;
LowSequence::LowSequence(LowSequence&&) noexcept = default;
LowSequence& LowSequence::operator=(LowSequence&&) noexcept = default;

const SheetPosePercept& LowSequence::step(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch) {
  impl_->clear(stamp);
  if (impl_->last_stamp && stamp <= *impl_->last_stamp) {
    impl_->percept.reason = "the frame is not newer than the one before";
    return impl_->percept;
  }
  impl_->last_stamp = stamp;

  if (impl_->follow(image, stamp)) {
    if (sketch != nullptr) sketch->model = model_lines(impl_->eMc, impl_->setup, impl_->percept.sheet_width_m);
  } else if (!impl_->dead_reckon(image, stamp)) {
    impl_->acquire(image, stamp, sketch);
  }
  return impl_->percept;
}

LowViewPrediction LowSequence::predict(Stamp stamp) const { return impl_->predict_body(stamp); }

const LowSequenceDiagnosis& LowSequence::diagnosis() const { return impl_->diagnosis; }

void LowSequence::Impl::clear(Stamp stamp) {
  percept.ok = false;
  percept.reason.clear();
  percept.stamp = stamp;
  percept.features.clear();
  diagnosis.tracked = diagnosis.blind = false;
  diagnosis.lost.clear();
  diagnosis.places = 0;
  diagnosis.search_px = diagnosis.innovation = 0.0;
}

bool LowSequence::Impl::give_up(std::string why) {
  diagnosis.lost = std::move(why);
  diagnosis.frames_tracked = 0;
  tracking = false;
  return false;
}

// False: lost, with the reason in the diagnosis.
bool LowSequence::Impl::follow(const cv::Mat& image, Stamp stamp) {
  if (!tracking) return give_up("no frame before shows the hog line");
  if (seconds(stamp - across.last_stamp()) > longest_gap_s) return give_up("the frames before are too old");
  const SheetFitResult& result = follow_at_any_speed(image, stamp);
  diagnosis.places = track.diagnosis().places;
  diagnosis.search_px = track.diagnosis().search_px;
  diagnosis.innovation = track.diagnosis().innovation;
  if (!take(result, stamp)) return false;
  if (track.diagnosis().moved_px > standing_px) remember_pitch();
  ++diagnosis.frames_tracked;
  return true;
}

// A step of full speed between two frames is too long for one search as long as the speed is not known.
const SheetFitResult& LowSequence::Impl::follow_at_any_speed(const cv::Mat& image, Stamp stamp) {
  const SheetFitResult& result = track.follow(image, predict_camera(stamp));
  if (along.known() || (result.ok && hog_line_seen(result))) return result;
  for (const double speed_mps : {0.0, 0.9, 2.6, 3.5}) {
    SheetPrediction other = predict_camera(stamp);
    const double ahead_m = (speed_mps - along.speed_mps(stamp)) * seconds(stamp - along.last_stamp());
    other.eMc.translation().y() += ahead_m;
    if (track.follow(image, other).ok && hog_line_seen(result)) break;
  }
  return result;
}

bool LowSequence::Impl::take(const SheetFitResult& result, Stamp stamp) {
  if (!result.ok) return give_up(result.reason);
  if (std::string why = doubt_of_mount(result.eMc, setup); !why.empty()) return give_up(std::move(why));
  if (std::string why = doubt_of_response(result); !why.empty()) return give_up(std::move(why));
  if (!hog_line_seen(result)) {
    if (!take_blind(result, stamp)) return false;
  } else {
    if (sidelines_left_behind(result)) return give_up("the sidelines are not where the frames before put them");
    by_sidelines = sidelines_of(result).used > 0;
    percept.features.emplace_back("tracked");
    fill_low_percept(result, setup, percept);
    along.add(stamp, {percept.body, percept.sigma});
    across.add(stamp, {percept.body, percept.sigma});
  }
  if (!percept.sheet_width_m) percept.sheet_width_m = width_m;
  eMc = from_row_major(percept.eMc);
  body = percept.body;
  diagnosis.tracked = true;
  return true;
}

bool LowSequence::Impl::hog_line_seen(const SheetFitResult& result) const {
  const FittedFeature* hog = hog_line_of(result);
  return hog != nullptr && hog->sites_used >= fewest_hog_places &&
         hog->sites_used >= least_hog_share * hog->sites_tried && result.sigma.y_m < most_sigma_m;
}

// Where sidelines lie in pairs a search may end on the neighbour's, and the fit does without them: hog line and centre
// line alone hardly tell the distance from the lean. An acquisition finds them again.
bool LowSequence::Impl::sidelines_left_behind(const SheetFitResult& result) const {
  const SidelineSites now = sidelines_of(result);
  return by_sidelines && now.used == 0 && now.tried >= fewest_sideline_places;
}

// The hog line has left the picture: its distance by dead reckoning, the rest as measured.
bool LowSequence::Impl::take_blind(const SheetFitResult& result, Stamp stamp) {
  const RunPlace reckoned = place(stamp);
  if (!hog_line_below(reckoned.body)) return give_up("the hog line is not where the frames before put it");
  if (seconds(stamp - along.last_stamp()) > longest_blind_s) return give_up("the hog line was seen too long ago");
  if (!(result.sigma.x_m < most_across_m)) return give_up("nothing in view tells the place across the sheet");
  percept.features.emplace_back("dead_reckoning");
  fill_low_percept(result, setup, percept);
  Pose moved = result.eMc;
  moved.translation().y() += reckoned.body.y_m - result.body.y_m;
  percept.eMc = row_major(moved);
  percept.body.y_m = reckoned.body.y_m;
  percept.hog_distance_m = rules::tee_to_hog_m - reckoned.body.y_m;
  percept.sigma.y_m = percept.hog_distance_sigma_m = reckoned.sigma.y_m;
  across.add(stamp, {percept.body, percept.sigma});
  diagnosis.blind = true;
  return true;
}

// The track was lost, and the line is expected below the picture: a line that should be in view and is not was not
// seen. What else is painted may be found again.
bool LowSequence::Impl::dead_reckon(const cv::Mat& image, Stamp stamp) {
  if (along.empty() || !along.known() || seconds(stamp - along.last_stamp()) > longest_blind_s) return false;
  const RunPlace reckoned = place(stamp);
  if (!hog_line_below(reckoned.body)) return false;
  const std::string lost = diagnosis.lost;
  tracking = take(track.begin(image, track_start(predict_camera(stamp).eMc)), stamp);
  if (tracking) remember_pitch();
  diagnosis.lost = lost;
  if (tracking) return true;
  percept.ok = true;
  percept.body = reckoned.body;
  percept.sigma = reckoned.sigma;
  percept.hog_distance_m = rules::tee_to_hog_m - reckoned.body.y_m;
  percept.hog_distance_sigma_m = reckoned.sigma.y_m;
  percept.sheet_width_m = width_m;
  percept.eMc = row_major(eMb(reckoned.body) * bMc(setup.mount));
  percept.residual_px = 0.0;
  percept.sites_used = percept.sites_tried = 0;
  percept.features.emplace_back("dead_reckoning");
  diagnosis.blind = true;
  return true;
}

void LowSequence::Impl::acquire(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch) {
  if (!along.empty() && seconds(stamp - along.last_stamp()) > longest_blind_s) forget();
  percept = view.acquire(image, stamp, predict_body(stamp), sketch);
  if (!percept.ok && !along.empty() && seconds(stamp - along.last_stamp()) > longest_gap_s) {
    // What the frames before say is no longer to be relied on.
    forget();
    percept = view.acquire(image, stamp, predict_body(stamp), sketch);
  }
  if (!percept.ok && !along.empty()) percept.reason += " (where the frames before put it)";
  if (!percept.ok) return;
  percept.features.reserve(most_features);
  percept.features.insert(percept.features.begin(), "acquired");
  if (percept.sheet_width_m) width_m = percept.sheet_width_m;
  along.add(stamp, {percept.body, percept.sigma});
  across.add(stamp, {percept.body, percept.sigma});
  eMc = from_row_major(percept.eMc);
  body = percept.body;
  by_sidelines = std::any_of(percept.features.begin(), percept.features.end(),
                             [](const std::string& f) { return f == "left_sideline" || f == "right_sideline"; });

  tracking = track.begin(view.fit(), track_start(eMc)).ok;
  remember_pitch();
}

void LowSequence::Impl::forget() {
  along.clear();
  across.clear();
}

void LowSequence::Impl::remember_pitch() {
  pitch = {track.result().eMc, track.diagnosis().pitch_offset_rad, track.diagnosis().pitch_sigma_rad, rock_rad};
}

SheetFitStart LowSequence::Impl::track_start(const Pose& near_by) const {
  SheetFitStart start;
  start.eMc = near_by;
  start.search_px = acquired_search_px;
  start.sheet_width_m = width_m;
  start.most_sigma_m = any_sigma_m;
  start.pitch_sigma_rad = lean_sigma_rad;
  start.roll_sigma_rad = low_mount::roll_sigma_rad;
  start.height_sigma_m = low_mount::height_sigma_m;
  return start;
}

RunPlace LowSequence::Impl::place(Stamp stamp) const {
  RunPlace there = across.at(stamp);
  const RunPlace ahead = along.at(stamp);
  there.body.y_m = ahead.body.y_m;
  there.sigma.y_m = ahead.sigma.y_m;
  return there;
}

LowViewPrediction LowSequence::Impl::predict_body(Stamp stamp) const {
  LowViewPrediction prediction;
  prediction.sheet_width_m = width_m;
  if (along.empty()) return prediction;
  const RunPlace there = place(stamp);
  prediction.body = there.body;
  prediction.body_sigma = there.sigma;
  return prediction;
}

// The camera as it was in the newest place, moved with the body; the rest is what a running body can do in a frame.
SheetPrediction LowSequence::Impl::predict_camera(Stamp stamp) const {
  const RunPlace there = place(stamp);
  SheetPrediction prediction;
  prediction.pitch = pitch;
  prediction.eMc = eMb(there.body) * eMb(body).inverse() * eMc;
  const Eigen::Matrix3d eRc = prediction.eMc.linear();
  const Eigen::Matrix3d eRb = eMb(there.body).linear();
  const Eigen::Vector3d place_sigma(least_sigma_m + there.sigma.x_m, least_sigma_m + there.sigma.y_m, heave_m);
  const Eigen::Vector3d turn_sigma(roll_rad, rock_rad, least_sigma_rad + there.sigma.yaw_rad);
  const Eigen::Matrix3d cRb = eRc.transpose() * eRb;
  prediction.covariance.setZero();
  prediction.covariance.topLeftCorner<3, 3>() = eRc.transpose() * place_sigma.cwiseAbs2().asDiagonal() * eRc;
  prediction.covariance.bottomRightCorner<3, 3>() = cRb * turn_sigma.cwiseAbs2().asDiagonal() * cRb.transpose();
  prediction.travel.setZero();
  prediction.travel.head<3>() = eRc.row(1).transpose() * along.speed_mps(stamp) * exposure_s;
  return prediction;
}

bool LowSequence::Impl::hog_line_below(const PlanarPose& there) const {
  const SheetCamera camera(lens, eMb(there) * bMc(setup.mount), setup.ice);
  const auto near_edge = camera.project_paint({camera.eMc().translation().x(), rules::tee_to_hog_m});
  // Its house-side edge and some ice before it must be in view to see it.
  const double margin_px = 0.025 * setup.intrinsics.height_px;
  return !near_edge || near_edge->y() > setup.intrinsics.height_px - margin_px;
}

}  // namespace hogline::vision
