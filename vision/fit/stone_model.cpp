#include "vision/fit/stone_model.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double foot_height = -0.3;    // below it the outline melts into the stone's own shadow
constexpr double shade_px = 8.0;        // granite darkens downwards: scale of that slope
constexpr double hidden_px = -2.0;      // so near to a nearer stone nothing is believed
constexpr double grip_height_m = 0.06;  // over the handle's rim
constexpr double neighbour_m = 2.5;     // farther stones hide nothing of each other
constexpr double most_step_m = 0.06;
constexpr std::size_t fewest_pixels = 40;
constexpr double colour_weight = 0.4;  // neighbouring pixels share their colours

// Brightness, and two colours that are zero for grey; from blue, green, red.
const Eigen::Matrix3d to_parts =
    (Eigen::Matrix3d() << 0.114, 0.587, 0.299, -0.114, -0.587, 0.701, 0.886, -0.587, -0.299).finished();
const Eigen::Matrix3d from_parts = to_parts.inverse();

/// The normal distribution's integral and density, tabulated.
class NormalTable {
 public:
  NormalTable() {
    for (int i = 0; i < size; ++i) {
      const double z = i / per_unit - reach;
      integral_[static_cast<std::size_t>(i)] = 0.5 * std::erfc(-z / std::numbers::sqrt2);
      density_[static_cast<std::size_t>(i)] = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    }
  }
  struct Value {
    double integral, density;
  };
  Value at(double z) const {
    if (z <= -reach) return {0.0, 0.0};
    if (z >= reach) return {1.0, 0.0};
    const double u = (z + reach) * per_unit;
    const auto i = static_cast<std::size_t>(u);
    const double f = u - static_cast<double>(i);
    return {integral_[i] + f * (integral_[i + 1] - integral_[i]), density_[i] + f * (density_[i + 1] - density_[i])};
  }

 private:
  static constexpr double reach = 4.0;
  static constexpr double per_unit = 64.0;
  static constexpr int size = 514;
  std::array<double, size> integral_{};
  std::array<double, size> density_{};
};

const NormalTable normal_table;

}  // namespace

SharedVector numbers_of(const SharedLook& look) {
  SharedVector v;
  v << look.shape.handle_thickness_m, look.shape.body_radius_m, look.shape.body_half_height_m,
      look.shape.handle_height_m, look.shape.handle_radius_m, look.wall_light, look.blur_px, look.colour_blur_px;
  return v;
}

SharedLook look_of(const SharedVector& numbers) {
  SharedLook look;
  look.shape.handle_thickness_m = std::clamp(numbers[0], 0.002, 0.05);
  look.shape.body_radius_m = std::clamp(numbers[1], 0.13, 0.15);
  look.shape.body_half_height_m = std::clamp(numbers[2], 0.04, 0.08);
  look.shape.handle_height_m = numbers[3];
  look.shape.handle_radius_m = numbers[4];
  look.wall_light = std::clamp(numbers[5], 0.2, 1.2);
  look.blur_px = std::clamp(numbers[6], 0.4, 2.5);
  look.colour_blur_px = std::clamp(numbers[7], 0.4, 3.0);
  return look;
}

StoneModel::StoneModel(const PatchSource& source, const SheetCamera& camera, const StoneShape& shape,
                       const Eigen::Vector2d& start, std::size_t most)
    : source_(source), place_(start), eye_(camera.eMc().translation()) {
  raw_ = stone_pixels(source_, camera, {place_, shape}, most);
  pixels_.resize(raw_.size());
  double middle = 0.0;
  for (const StonePixel& p : raw_) middle += p.pixel.y() / static_cast<double>(raw_.size());
  for (std::size_t i = 0; i < raw_.size(); ++i) {
    pixels_[i].light = to_parts * raw_[i].light;
    pixels_[i].shade = (raw_[i].pixel.y() - middle) / shade_px;
  }
}

void StoneModel::move(const Eigen::Vector2d& step) {
  place_ += step.norm() > most_step_m ? Eigen::Vector2d(step * (most_step_m / step.norm())) : step;
}

Eigen::Matrix2d StoneModel::unknowable(double height_sigma_m) const {
  const Bearing bearing = bearing_of(place_, eye_);
  const double along_m = height_sigma_m * bearing.range_m / std::max(0.1, eye_.z() - 0.1);
  return along_m * along_m * bearing.away * bearing.away.transpose() +
         0.25 * height_sigma_m * height_sigma_m * Eigen::Matrix2d::Identity();
}

void StoneModel::look_behind(const SharedLook& look) {
  vision::look_behind(source_, {place_, look.shape}, eye_, coloured_ ? handle_colour() : Light::Zero(), raw_);
  for (std::size_t i = 0; i < raw_.size(); ++i) pixels_[i].behind = to_parts * raw_[i].behind;
}

void StoneModel::hide_behind(const NearerStone& nearer, const SharedLook& look) {
  if ((nearer.place - place_).norm() > neighbour_m || (nearer.place - eye_.head<2>()).norm() >= range_m()) return;
  const StonePlace front{nearer.place, look.shape};
  StonePlace grip = front;
  grip.shape.handle_height_m += grip_height_m;
  grip.shape.handle_thickness_m = grip_height_m;
  const StonePlace own{place_, look.shape};
  for (StonePixel& p : raw_) {
    if (!p.usable) continue;
    const double px = std::max(handle_distance(front, eye_, p.sight).px, body_distance(front, eye_, p.sight).px);
    if (px > hidden_px) {
      p.usable = false;
    } else if (handle_distance(grip, eye_, p.sight).px > 0.0 && handle_distance(own, eye_, p.sight).px < -1.0) {
      const bool alike = (p.light - nearer.handle).norm() < 0.5 * (p.light - Light::Constant(0.25)).norm();
      if (alike) p.usable = false;
    }
  }
}

void StoneModel::mix(const SharedLook& look) {
  const StonePlace stone{place_, look.shape};
  const auto blurred = [&look](const Pixel& p, double blur) {
    const auto handle = normal_table.at(p.handle.px / blur);
    const auto face = normal_table.at(p.face.px / blur);
    const auto body = normal_table.at(p.body.px / blur);
    Blurred b;
    b.handle = handle.integral;
    b.face = face.integral;
    b.plate = look.wall_light * handle.integral + (1.0 - look.wall_light) * face.integral;
    b.body = body.integral;
    b.by_handle = handle.density / blur;
    b.by_face = face.density / blur;
    b.by_body = body.density / blur;
    b.handle_by_blur = -b.by_handle * p.handle.px / blur;
    b.face_by_blur = -b.by_face * p.face.px / blur;
    b.body_by_blur = -b.by_body * p.body.px / blur;
    return b;
  };
  for (std::size_t i = 0; i < raw_.size(); ++i) {
    Pixel& p = pixels_[i];
    p.used = raw_[i].usable;
    if (!p.used) continue;
    p.handle = handle_distance(stone, eye_, raw_[i].sight);
    p.body = body_distance(stone, eye_, raw_[i].sight);
    p.used = !(p.body.px > p.handle.px && p.body.height < foot_height && p.body.px < 2.5);
    if (!p.used) continue;
    p.face = face_distance(stone, eye_, raw_[i].sight);
    p.fine = blurred(p, look.blur_px);
    p.coarse = blurred(p, look.colour_blur_px);
  }
}

void StoneModel::find_colours(const SharedLook& look) {
  mix(look);
  std::array<Eigen::Matrix3d, 2> normal;
  normal.fill(1e-6 * Eigen::Matrix3d::Identity());
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  for (const Pixel& p : pixels_) {
    if (!p.used) continue;
    for (std::size_t part = 0; part < 2; ++part) {
      const Blurred& b = part == 0 ? p.fine : p.coarse;
      const double granite = (1.0 - b.handle) * b.body;
      const Eigen::Vector3d basis(b.plate, granite, granite * p.shade);
      normal[part] += p.weight * basis * basis.transpose();
      const double rest = (1.0 - b.handle) * (1.0 - b.body);
      if (part == 0) {
        right.col(0) += p.weight * (p.light[0] - rest * p.behind[0]) * basis;
      } else {
        right.col(1) += p.weight * (p.light[1] - rest * p.behind[1]) * basis;
        right.col(2) += p.weight * (p.light[2] - rest * p.behind[2]) * basis;
      }
    }
  }
  Eigen::Matrix3d found;
  for (std::size_t part = 0; part < 2; ++part) normal[part](2, 2) += 1e-2 * normal[part](1, 1);
  found.col(0) = normal[0].ldlt().solve(right.col(0));
  found.rightCols<2>() = normal[1].ldlt().solve(right.rightCols<2>());
  if (found.allFinite()) colours_ = found;
  coloured_ = true;
}

void StoneModel::linearise(const SharedLook& look) {
  find_colours(look);
  normal_.setZero();
  right_.setZero();
  std::array<Eigen::Matrix3d, 2> colour_normal;
  colour_normal.fill(1e-6 * Eigen::Matrix3d::Identity());
  std::array<Eigen::Matrix<double, 3, model_numbers>, 3> cross;
  for (auto& c : cross) c.setZero();
  Eigen::Matrix3d colour_right = Eigen::Matrix3d::Zero();
  std::vector<double> sizes;
  sizes.reserve(pixels_.size());
  double left = 0.0;
  double plain_left = 0.0;
  double difference = 0.0;
  double weights = 0.0;
  used_ = 0;
  for (Pixel& p : pixels_) {
    if (!p.used) continue;
    std::array<ModelVector, 3> slope;
    std::array<Eigen::Vector3d, 2> basis;
    Light residual;
    for (int k = 0; k < 3; ++k) {
      const Blurred& b = k == 0 ? p.fine : p.coarse;
      const double handle = colours_(0, k);
      const double stone = colours_(1, k) + p.shade * colours_(2, k);
      const double under = b.body * stone + (1.0 - b.body) * p.behind[k];
      residual[k] = p.light[k] - (b.plate * handle + (1.0 - b.handle) * under);
      const double to_handle = look.wall_light * handle - under;
      const double to_face = (1.0 - look.wall_light) * handle;
      const double to_body = (1.0 - b.handle) * (stone - p.behind[k]);
      ModelVector& j = slope[static_cast<std::size_t>(k)];
      j.head<7>() =
          to_handle * b.by_handle * p.handle.by + to_face * b.by_face * p.face.by + to_body * b.by_body * p.body.by;
      j[7] = (b.handle - b.face) * handle;
      const double by_blur = to_handle * b.handle_by_blur + to_face * b.face_by_blur + to_body * b.body_by_blur;
      j[8] = k == 0 ? by_blur : 0.0;
      j[9] = k == 0 ? 0.0 : by_blur;
      const double granite = (1.0 - b.handle) * b.body;
      basis[k == 0 ? 0 : 1] = {b.plate, granite, granite * p.shade};
    }
    // Shot noise grows with the light; what is behind was measured with noise, too.
    const double noise = 0.02 + 0.5 * std::max(0.0, p.light[0] + p.behind[0]);
    const double size =
        std::sqrt((residual[0] * residual[0] + colour_weight * residual.tail<2>().squaredNorm()) / noise);
    sizes.push_back(size);
    const double robust = scale_ > 0.0 ? 1.0 / (1.0 + (size / scale_) * (size / scale_)) : 1.0;
    p.weight = robust / noise;
    for (int k = 0; k < 3; ++k) {
      const double w = k == 0 ? p.weight : colour_weight * p.weight;
      const auto& j = slope[static_cast<std::size_t>(k)];
      normal_.selfadjointView<Eigen::Lower>().rankUpdate(j, w);
      right_ += w * residual[k] * j;
      const auto& f = basis[k == 0 ? 0 : 1];
      cross[static_cast<std::size_t>(k)] += w * f * j.transpose();
      colour_right.col(k) += w * residual[k] * f;
    }
    colour_normal[0] += p.weight * basis[0] * basis[0].transpose();
    colour_normal[1] += colour_weight * p.weight * basis[1] * basis[1].transpose();
    left += p.weight * size * size * noise;
    plain_left += p.weight * residual[0] * residual[0];
    const Light change = p.light - p.behind;
    difference += p.weight * (change[0] * change[0] + colour_weight * change.tail<2>().squaredNorm());
    weights += p.weight;
    ++used_;
  }
  normal_.triangularView<Eigen::StrictlyUpper>() = normal_.transpose();
  for (int k = 0; k < 3; ++k) {
    const auto& c = cross[static_cast<std::size_t>(k)];
    const Eigen::LDLT<Eigen::Matrix3d> colours(colour_normal[k == 0 ? 0 : 1]);
    normal_ -= c.transpose() * colours.solve(c);
    right_ -= c.transpose() * colours.solve(colour_right.col(k));
  }
  if (!sizes.empty()) {
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    scale_ = std::max(0.02, 2.0 * *middle);
  }
  variance_ = left / (2.0 * static_cast<double>(std::max<std::size_t>(1, used_)));
  residual_ = weights > 0.0 ? std::sqrt(plain_left / weights) : 0.0;
  explained_ = difference > 0.0 ? 1.0 - left / difference : 0.0;
}

bool StoneModel::enough() const { return used_ >= fewest_pixels; }

double StoneModel::visible() const {
  return pixels_.empty() ? 0.0 : static_cast<double>(used_) / static_cast<double>(pixels_.size());
}

Light StoneModel::handle_colour() const { return from_parts * colours_.row(0).transpose(); }
Light StoneModel::granite_colour() const { return from_parts * colours_.row(1).transpose(); }

Light StoneModel::behind_colour() const {
  Light sum = Light::Zero();
  double count = 0.0;
  for (const Pixel& p : pixels_) {
    if (!p.used || p.fine.body > 0.5 || p.fine.handle > 0.5) continue;
    sum += p.behind;
    count += 1.0;
  }
  return count > 0.0 ? Light(from_parts * (sum / count)) : Light::Zero();
}

}  // namespace hogline::vision
