#include "vision/fit/stone_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "vision/fit/stone_model.hpp"

namespace hogline::vision {
namespace {

// What the rules, clubs' stones and cameras leave open, about the values of StoneShape and SharedLook.
constexpr double thickness_sigma_m = 0.008;
constexpr double radius_sigma_m = 0.0025;
constexpr double half_height_sigma_m = 0.004;
constexpr double handle_radius_sigma_m = 0.001;  // of a measurement on site, and of what the edge of a round rim is
constexpr double correlated = 4.0;               // neighbouring pixels share their noise: colour mosaic, compression
constexpr double rim_doubt_m = 0.0020;           // how high a rounded rim seems, against what was measured on site
constexpr double wall_light_sigma = 0.15;
constexpr double blur_sigma_px = 0.2;
constexpr double colour_blur_sigma_px = 0.5;
constexpr double hopelessly_told = 0.3;  // where a fit begins: from there it does not come to a stone
constexpr double hopelessly_explained = 0.4;

SharedVector prior_weights() {
  SharedVector sigma;
  sigma << thickness_sigma_m, radius_sigma_m, half_height_sigma_m, handle_radius_sigma_m, wall_light_sigma,
      blur_sigma_px, colour_blur_sigma_px;
  return sigma.cwiseAbs2().cwiseInverse();
}

SharedVector longest_step() {
  SharedVector step;
  step << 0.004, 0.004, 0.004, 0.003, 0.2, 0.15, 0.3;
  return step;
}

/// A stone's normal equations, parted into its place and the shared numbers, in units of its noise.
struct Parts {
  Eigen::Matrix2d own;
  Eigen::Matrix<double, 2, shared_numbers> lever;
  SharedMatrix shared;
  Eigen::Vector2d own_right;
  SharedVector shared_right;

  explicit Parts(const StoneModel& s)
      : own(s.normal().topLeftCorner<2, 2>() / s.variance()),
        lever(s.normal().topRightCorner<2, shared_numbers>() / s.variance()),
        shared(s.normal().bottomRightCorner<shared_numbers, shared_numbers>() / s.variance()),
        own_right(s.right().head<2>() / s.variance()),
        shared_right(s.right().tail<shared_numbers>() / s.variance()) {}

  bool determined() const { return own.allFinite() && own.determinant() > 1e-6 * own.trace() * own.trace(); }
};

FittedStone fitted(const StoneModel& s, const SharedMatrix& shared_covariance) {
  FittedStone f;
  f.place = s.place();
  f.handle = s.handle_colour();
  f.granite = s.granite_colour();
  f.granite_pixels = s.granite_pixels();
  f.residual = s.residual();
  f.explained = s.explained();
  f.visible = s.visible();
  f.telling = s.telling();
  f.told = s.told();
  f.handle_told = s.handle_told();
  f.granite_told = s.granite_told();
  f.handle_contrast = (f.handle - f.granite).norm();
  f.body_contrast = (f.granite - s.behind_colour()).norm();
  const Parts parts(s);
  f.ok = s.enough() && f.place.allFinite() && parts.determined();
  if (!f.ok) {
    f.reason = "too little of it can be seen";
    return f;
  }
  const Eigen::Matrix2d own = parts.own.inverse();
  const Eigen::Matrix<double, 2, shared_numbers> lever = own * parts.lever;
  f.covariance = correlated * own + lever * shared_covariance * lever.transpose() + s.unknowable(rim_doubt_m);
  return f;
}

}  // namespace

void StoneFitter::begin(const StonePicture& picture, const std::vector<StoneStart>& starts,
                        const StoneFitOptions& options) {
  options_ = options;
  look_ = {};
  look_.shape = picture.shape;
  prior_ = numbers_of(look_);
  if (options.begin_with) look_ = *options.begin_with;
  stones_.clear();
  stones_.reserve(starts.size());
  for (const StoneStart& start : starts) {
    stones_.emplace_back(picture, look_, start.place, options.pixels);
    if (start.granite) stones_.back().expect_granite(*start.granite);
    if (start.before != nullptr) stones_.back().leave_out(*start.before);
  }
  settle_surroundings();
  for (StoneModel& s : stones_) s.find_colours(look_);
}

Light StoneFitter::first_granite() const { return stones_.empty() ? Light::Zero() : stones_.front().granite_colour(); }

const StoneFitResult& StoneFitter::run() {
  bool given_up = false;
  for (int i = 0; i < options_.iterations && !given_up; ++i) {
    if (i % 2 == 0) settle_surroundings();
    const bool with_shared = i >= 1 && options_.fit_shape;
    for (StoneModel& s : stones_) s.linearise(look_, with_shared);
    given_up = i == 0 && options_.give_up_hopeless && all_hopeless();
    if (!given_up) step(with_shared);
  }
  if (!given_up) conclude();
  result_.look = look_;
  result_.stones.clear();
  const SharedMatrix shared_covariance = shared_normal(options_.fit_shape).inverse();
  for (const StoneModel& s : stones_) result_.stones.push_back(fitted(s, shared_covariance));
  return result_;
}

void StoneFitter::conclude() {
  for (StoneModel& s : stones_) {
    s.linearise(look_, options_.covariance);
    s.conclude();
  }
}

bool StoneFitter::all_hopeless() {
  return std::all_of(stones_.begin(), stones_.end(), [](StoneModel& s) {
    s.conclude();
    return s.told() < hopelessly_told || s.explained() < hopelessly_explained;
  });
}

void StoneFitter::settle_surroundings() {
  for (StoneModel& s : stones_) s.look_behind(look_);
  for (StoneModel& s : stones_) {
    for (const StoneModel& other : stones_) {
      if (&other != &s) s.hide_behind({other.place(), other.handle_colour()}, look_);
    }
    for (const KnownStone& nearer : options_.nearer) s.hide_behind(nearer, look_);
  }
}

SharedMatrix StoneFitter::shared_normal(bool with_stones) const {
  SharedMatrix normal = prior_weights().asDiagonal();
  if (!with_stones) return normal;
  for (const StoneModel& s : stones_) {
    const Parts parts(s);
    if (!s.enough() || !parts.determined()) continue;
    normal += parts.shared - parts.lever.transpose() * parts.own.inverse() * parts.lever;
  }
  return normal;
}

SharedVector StoneFitter::shared_step() const {
  SharedVector right = prior_weights().cwiseProduct(prior_ - numbers_of(look_));
  for (const StoneModel& s : stones_) {
    const Parts parts(s);
    if (!s.enough() || !parts.determined()) continue;
    right += parts.shared_right - parts.lever.transpose() * parts.own.inverse() * parts.own_right;
  }
  const SharedVector step = shared_normal(true).ldlt().solve(right);
  if (!step.allFinite()) return SharedVector::Zero();
  return step.cwiseMin(longest_step()).cwiseMax(-longest_step());
}

void StoneFitter::step(bool with_shared) {
  const SharedVector shared = with_shared ? shared_step() : SharedVector::Zero();
  for (StoneModel& s : stones_) {
    const Parts parts(s);
    if (!s.enough() || !parts.determined()) continue;
    const Eigen::Vector2d own = parts.own.inverse() * (parts.own_right - parts.lever * shared);
    if (own.allFinite()) s.move(own);
  }
  look_ = look_of(numbers_of(look_) + shared, look_);
}

}  // namespace hogline::vision
