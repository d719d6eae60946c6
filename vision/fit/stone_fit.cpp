#include "vision/fit/stone_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double blur_px = 0.8;       // of lens, pixel and colour mosaic together
constexpr double foot_height = -0.3;  // below it the outline melts into the stone's own shadow
constexpr double shade_px = 8.0;      // granite darkens downwards: scale of that slope
constexpr double hidden_px = -2.0;    // so near to a nearer stone nothing is believed
constexpr double most_step_m = 0.06;
constexpr std::size_t fewest_pixels = 60;
// What the rules and clubs' stones leave of the shape.
constexpr double thickness_sigma_m = 0.008;
constexpr double radius_sigma_m = 0.0025;
constexpr double half_height_sigma_m = 0.004;

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// One pixel of one stone under the present estimate.
struct Mixture {
  double handle = 0.0;     // share of the handle
  double body = 0.0;       // share of the body in what the handle leaves
  double by_handle = 0.0;  // d(share)/d(px)
  double by_body = 0.0;
  double shade = 0.0;
  Vector5 handle_by = Vector5::Zero();
  Vector5 body_by = Vector5::Zero();
  double weight = 0.0;
  bool used = false;
};

struct Colours {
  Light handle = Light::Zero();
  Light granite = Light::Zero();
  Light shade = Light::Zero();
};

class StoneModel {
 public:
  StoneModel(const PatchSource& source, const Eigen::Vector2d& start) : source_(source), place_(start) {}

  void gather(const SheetCamera& camera, const StoneShape& shape, std::size_t most) {
    eye_ = camera.eMc().translation();
    pixels_ = stone_pixels(source_, camera, {place_, shape}, most);
    mixtures_.assign(pixels_.size(), {});
    for (Mixture& m : mixtures_) m.weight = 1.0;
  }

  void look_behind(const StoneShape& shape) { vision::look_behind(source_, {place_, shape}, eye_, colours_.handle, pixels_); }

  void hide_behind(const StoneModel& nearer, const StoneShape& shape) {
    const StonePlace front{nearer.place_, shape};
    for (StonePixel& p : pixels_) {
      if (p.usable && std::max(handle_distance(front, eye_, p.sight).px, body_distance(front, eye_, p.sight).px) > hidden_px)
        p.usable = false;
    }
  }

  void mix(const StoneShape& shape) {
    const StonePlace stone{place_, shape};
    double middle = 0.0;
    for (const StonePixel& p : pixels_) middle += p.pixel.y();
    middle /= static_cast<double>(std::max<std::size_t>(1, pixels_.size()));
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const StonePixel& p = pixels_[i];
      Mixture& m = mixtures_[i];
      const RegionDistance handle = handle_distance(stone, eye_, p.sight);
      const RegionDistance body = body_distance(stone, eye_, p.sight);
      const bool foot = body.px > handle.px && body.height < foot_height && body.px < 2.5;
      m.used = p.usable && !foot;
      m.handle = share(handle.px);
      m.body = share(body.px);
      m.by_handle = slope(handle.px);
      m.by_body = slope(body.px);
      m.handle_by = handle.by;
      m.body_by = body.by;
      m.shade = (p.pixel.y() - middle) / shade_px;
    }
  }

  bool find_colours() {
    Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero();  // a column for each colour channel
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const Mixture& m = mixtures_[i];
      if (!m.used) continue;
      const double granite = (1.0 - m.handle) * m.body;
      const Eigen::Vector3d basis(m.handle, granite, granite * m.shade);
      const Light left = pixels_[i].light - (1.0 - m.handle) * (1.0 - m.body) * pixels_[i].behind;
      normal += m.weight * basis * basis.transpose();
      right += m.weight * basis * left.transpose();
    }
    normal(2, 2) += 1e-3 * normal(1, 1) + 1e-6;
    const Eigen::Matrix3d found = normal.ldlt().solve(right);
    if (!found.allFinite()) return false;
    colours_.handle = found.row(0).transpose();
    colours_.granite = found.row(1).transpose();
    colours_.shade = found.row(2).transpose();
    return true;
  }

  /// Adds up the normal equations of place and shape with the colours eliminated, and weighs the pixels anew.
  void linearise() {
    hessian_.setZero();
    gradient_.setZero();
    Eigen::Matrix3d colour_normal = 1e-6 * Eigen::Matrix3d::Identity();
    std::array<Eigen::Matrix<double, 3, 5>, 3> cross;
    for (auto& c : cross) c.setZero();
    Eigen::Matrix3d colour_right = Eigen::Matrix3d::Zero();
    std::vector<double> sizes;
    double left = 0.0;
    double difference = 0.0;
    double weights = 0.0;
    used_ = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      Mixture& m = mixtures_[i];
      if (!m.used) continue;
      const StonePixel& p = pixels_[i];
      const Light stone = colours_.granite + m.shade * colours_.shade;
      const Light under = m.body * stone + (1.0 - m.body) * p.behind;
      const Light residual = p.light - (m.handle * colours_.handle + (1.0 - m.handle) * under);
      const Light by_handle = m.by_handle * (colours_.handle - under);
      const Light by_body = (1.0 - m.handle) * m.by_body * (stone - p.behind);
      // Shot noise grows with the light; what is behind was measured with noise, too.
      const double noise = 0.02 + 0.5 * (p.light.sum() + p.behind.sum()) / 3.0;
      const double size = std::sqrt(residual.squaredNorm() / noise);
      sizes.push_back(size);
      const double robust = scale_ > 0.0 ? 1.0 / (1.0 + (size / scale_) * (size / scale_)) : 1.0;
      m.weight = robust / noise;
      const double granite = (1.0 - m.handle) * m.body;
      const Eigen::Vector3d basis(m.handle, granite, granite * m.shade);
      colour_normal += m.weight * basis * basis.transpose();
      colour_right += m.weight * basis * residual.transpose();
      for (int k = 0; k < 3; ++k) {
        const Vector5 j = by_handle[k] * m.handle_by + by_body[k] * m.body_by;
        hessian_ += m.weight * j * j.transpose();
        gradient_ += m.weight * residual[k] * j;
        cross[static_cast<std::size_t>(k)] += m.weight * basis * j.transpose();
      }
      left += m.weight * residual.squaredNorm();
      difference += m.weight * (p.light - p.behind).squaredNorm() * (m.body > 0.02 || m.handle > 0.02 ? 1.0 : 0.0);
      weights += m.weight * 3.0;
      ++used_;
    }
    const Eigen::LDLT<Eigen::Matrix3d> colours(colour_normal);
    for (int k = 0; k < 3; ++k) {
      const auto& c = cross[static_cast<std::size_t>(k)];
      hessian_ -= c.transpose() * colours.solve(c);
      gradient_ -= c.transpose() * colours.solve(colour_right.col(k));
    }
    if (!sizes.empty()) {
      const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      scale_ = std::max(0.02, 2.5 * *middle / 1.2);
    }
    variance_ = weights > 0.0 ? left / (3.0 * static_cast<double>(std::max<std::size_t>(1, used_))) : 0.0;
    residual_ = weights > 0.0 ? std::sqrt(left / weights) : 0.0;
    explained_ = difference > 0.0 ? 1.0 - left / difference : 0.0;
  }

  bool enough() const { return used_ >= fewest_pixels / 2 && pixels_.size() >= fewest_pixels; }
  double visible() const { return pixels_.empty() ? 0.0 : static_cast<double>(used_) / static_cast<double>(pixels_.size()); }

  const Eigen::Vector2d& place() const { return place_; }
  void move(const Eigen::Vector2d& step) { place_ += step.norm() > most_step_m ? Eigen::Vector2d(step * (most_step_m / step.norm())) : step; }
  const Matrix5& hessian() const { return hessian_; }
  const Vector5& gradient() const { return gradient_; }
  const Colours& colours() const { return colours_; }
  double variance() const { return variance_; }
  double residual() const { return residual_; }
  double explained() const { return explained_; }
  double range_m() const { return (place_ - eye_.head<2>()).norm(); }
  Light behind() const {
    Light sum = Light::Zero();
    double n = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      if (!mixtures_[i].used || mixtures_[i].body > 0.5 || mixtures_[i].handle > 0.5) continue;
      sum += pixels_[i].behind;
      n += 1.0;
    }
    return n > 0.0 ? Light(sum / n) : Light::Zero();
  }

 private:
  static double share(double px) { return 0.5 * std::erfc(-px / (std::numbers::sqrt2 * blur_px)); }
  static double slope(double px) {
    return std::exp(-0.5 * px * px / (blur_px * blur_px)) / (blur_px * std::sqrt(2.0 * std::numbers::pi));
  }

  PatchSource source_;
  Eigen::Vector2d place_;
  Eigen::Vector3d eye_;
  std::vector<StonePixel> pixels_;
  std::vector<Mixture> mixtures_;
  Colours colours_;
  Matrix5 hessian_ = Matrix5::Zero();
  Vector5 gradient_ = Vector5::Zero();
  double scale_ = 0.0;
  double variance_ = 0.0;
  double residual_ = 0.0;
  double explained_ = 0.0;
  std::size_t used_ = 0;
};

/// All stones of a picture and the shape they share.
class JointFit {
 public:
  JointFit(const cv::Mat& bgr, const ResponseCurve& response, const IceLight& ice, const SheetCamera& camera,
           const StoneShape& shape, const std::vector<Eigen::Vector2d>& starts, const StoneFitOptions& options)
      : prior_(shape), shape_(shape), options_(options) {
    for (const Eigen::Vector2d& start : starts) {
      const auto pixel = camera.project({start.x(), start.y(), shape.handle_height_m});
      Light white = Light::Ones();
      if (pixel) {
        const auto light = ice.at(pixel->x(), pixel->y());
        white = Light(light[0], light[1], light[2]);
      }
      stones_.emplace_back(PatchSource{bgr, response, white}, start);
      stones_.back().gather(camera, shape, options.pixels);
    }
  }

  void run() {
    for (int i = 0; i < options_.iterations; ++i) {
      for (StoneModel& s : stones_) s.mix(shape_);
      if (i % 2 == 0) settle_surroundings();
      for (StoneModel& s : stones_) {
        s.mix(shape_);
        s.find_colours();
        s.linearise();
      }
      step(i >= 1 && options_.fit_shape);
    }
    for (StoneModel& s : stones_) {
      s.mix(shape_);
      s.find_colours();
      s.linearise();
    }
  }

  StoneFitResult result() const {
    StoneFitResult r;
    r.shape = shape_;
    const Eigen::Matrix3d shape_covariance = shape_normal(options_.fit_shape).inverse();
    for (const StoneModel& s : stones_) {
      FittedStone f;
      f.place = s.place();
      f.handle = s.colours().handle;
      f.granite = s.colours().granite;
      f.residual = s.residual();
      f.explained = s.explained();
      f.visible = s.visible();
      f.handle_contrast = (f.handle - f.granite).norm();
      f.body_contrast = (f.granite - s.behind()).norm();
      const Eigen::Matrix2d own = s.hessian().topLeftCorner<2, 2>();
      f.ok = s.enough() && f.place.allFinite() && own.determinant() > 0.0;
      if (!s.enough()) f.reason = "too little of it can be seen";
      if (f.ok) {
        const Eigen::Matrix2d inverse = own.inverse();
        const Eigen::Matrix<double, 2, 3> lever = inverse * s.hessian().topRightCorner<2, 3>();
        f.covariance = s.variance() * inverse + lever * shape_covariance * lever.transpose();
      }
      r.stones.push_back(f);
    }
    return r;
  }

 private:
  void settle_surroundings() {
    for (StoneModel& s : stones_) s.look_behind(shape_);
    for (StoneModel& s : stones_) {
      for (const StoneModel& other : stones_) {
        if (&other != &s && other.range_m() < s.range_m() && (other.place() - s.place()).norm() < 2.5) {
          s.hide_behind(other, shape_);
        }
      }
    }
  }

  Eigen::Matrix3d shape_normal(bool with_stones) const {
    Eigen::Matrix3d normal = Eigen::Vector3d(1.0 / (thickness_sigma_m * thickness_sigma_m),
                                             1.0 / (radius_sigma_m * radius_sigma_m),
                                             1.0 / (half_height_sigma_m * half_height_sigma_m))
                                 .asDiagonal();
    if (!with_stones) return normal;
    for (const StoneModel& s : stones_) {
      if (!s.enough() || !(s.variance() > 0.0)) continue;
      const Eigen::Matrix2d own = s.hessian().topLeftCorner<2, 2>();
      if (!(own.determinant() > 0.0)) continue;
      const Eigen::Matrix<double, 2, 3> lever = s.hessian().topRightCorner<2, 3>();
      normal += (s.hessian().bottomRightCorner<3, 3>() - lever.transpose() * own.inverse() * lever) / s.variance();
    }
    return normal;
  }

  void step(bool with_shape) {
    Eigen::Vector3d shape_step = Eigen::Vector3d::Zero();
    if (with_shape) {
      Eigen::Vector3d right((prior_.handle_thickness_m - shape_.handle_thickness_m) / (thickness_sigma_m * thickness_sigma_m),
                            (prior_.body_radius_m - shape_.body_radius_m) / (radius_sigma_m * radius_sigma_m),
                            (prior_.body_half_height_m - shape_.body_half_height_m) / (half_height_sigma_m * half_height_sigma_m));
      for (const StoneModel& s : stones_) {
        if (!s.enough() || !(s.variance() > 0.0)) continue;
        const Eigen::Matrix2d own = s.hessian().topLeftCorner<2, 2>();
        if (!(own.determinant() > 0.0)) continue;
        const Eigen::Matrix<double, 2, 3> lever = s.hessian().topRightCorner<2, 3>();
        right += (s.gradient().tail<3>() - lever.transpose() * own.inverse() * s.gradient().head<2>()) / s.variance();
      }
      shape_step = shape_normal(true).ldlt().solve(right);
      if (!shape_step.allFinite()) shape_step.setZero();
      shape_step = shape_step.cwiseMin(0.004).cwiseMax(-0.004);
      shape_.handle_thickness_m = std::clamp(shape_.handle_thickness_m + shape_step[0], 0.001, 0.05);
      shape_.body_radius_m = std::clamp(shape_.body_radius_m + shape_step[1], 0.13, 0.15);
      shape_.body_half_height_m = std::clamp(shape_.body_half_height_m + shape_step[2], 0.04, 0.08);
    }
    for (StoneModel& s : stones_) {
      if (!s.enough()) continue;
      Eigen::Matrix2d own = s.hessian().topLeftCorner<2, 2>();
      own += 1e-6 * own.trace() * Eigen::Matrix2d::Identity();
      if (!(own.determinant() > 0.0)) continue;
      const Eigen::Vector2d right = s.gradient().head<2>() - s.hessian().topRightCorner<2, 3>() * shape_step;
      const Eigen::Vector2d own_step = own.inverse() * right;
      if (own_step.allFinite()) s.move(own_step);
    }
  }

  StoneShape prior_;
  StoneShape shape_;
  StoneFitOptions options_;
  std::vector<StoneModel> stones_;
};

}  // namespace

StoneFitResult fit_stones(const cv::Mat& bgr, const ResponseCurve& response, const IceLight& ice,
                          const SheetCamera& camera, const StoneShape& shape,
                          const std::vector<Eigen::Vector2d>& starts, const StoneFitOptions& options) {
  JointFit fit(bgr, response, ice, camera, shape, starts, options);
  fit.run();
  return fit.result();
}

}  // namespace hogline::vision
