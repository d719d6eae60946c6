#include "vision/planned_sheet.hpp"

#include <cmath>

#include "vision/fit/sheet_track.hpp"

namespace hogline::vision {
namespace {

constexpr double search_px = 12.0;  // joint zeros and the mount's pitch: a third of a degree
// What may change from picture to picture beside what the plan knows: drives that swing, stamps of joints and camera.
constexpr double changed_turn_rad = 6e-4;
constexpr double changed_place_m = 0.0015;
constexpr double longest_gap_s = 1.0;

}  // namespace

struct PlannedSheet::Impl {
  explicit Impl(const CameraSetup& setup) : fit(setup), track(setup) {}

  bool follow(const cv::Mat& image, const Pose& planned);
  const SheetFitResult& find(const cv::Mat& image, const Pose& planned, std::optional<double> sheet_width_m);

  SheetFit fit;
  SheetTrack track;
  Pose off = Pose::Identity();  ///< from where the last picture was planned to where it was
  std::optional<Stamp> last;
  bool tracked = false;
};

bool PlannedSheet::Impl::follow(const cv::Mat& image, const Pose& planned) {
  SheetPrediction prediction;
  prediction.eMc = planned * off;
  prediction.covariance.setZero();
  prediction.covariance.diagonal().head<3>().setConstant(changed_place_m * changed_place_m);
  prediction.covariance.diagonal().tail<3>().setConstant(changed_turn_rad * changed_turn_rad);
  prediction.travel.setZero();
  return track.follow(image, prediction).ok;
}

const SheetFitResult& PlannedSheet::Impl::find(const cv::Mat& image, const Pose& planned,
                                               std::optional<double> sheet_width_m) {
  SheetFitStart start;
  start.eMc = planned;
  start.search_px = search_px;
  start.sheet_width_m = sheet_width_m;
  start.may_be_hidden = true;
  const SheetFitResult& found = fit.fit(image, start);
  if (found.ok) track.begin(fit, start);
  return found;
}

PlannedSheet::PlannedSheet(const CameraSetup& setup) : impl_(std::make_unique<Impl>(setup)) {}
PlannedSheet::~PlannedSheet() = default;
PlannedSheet::PlannedSheet(PlannedSheet&&) noexcept = default;
PlannedSheet& PlannedSheet::operator=(PlannedSheet&&) noexcept = default;

const SheetFitResult& PlannedSheet::look(const cv::Mat& image, Stamp stamp, const Pose& planned,
                                         std::optional<double> sheet_width_m) {
  const bool recent = impl_->last && stamp > *impl_->last && seconds(stamp - *impl_->last) < longest_gap_s;
  impl_->tracked = recent && impl_->follow(image, planned);
  const SheetFitResult& seen = impl_->tracked ? impl_->track.result() : impl_->find(image, planned, sheet_width_m);
  impl_->last.reset();
  if (!seen.ok) return seen;
  impl_->off = planned.inverse() * seen.eMc;
  impl_->last = stamp;
  return seen;
}

bool PlannedSheet::tracked() const { return impl_->tracked; }

}  // namespace hogline::vision
