#include "vision/fit/stone_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "vision/fit/light_parts.hpp"
#include "vision/fit/normal_table.hpp"

namespace hogline::vision {
namespace {

constexpr float foot_height = -0.3F;  // below it the outline melts into the stone's own shadow
constexpr float near_foot_px = 2.5F;
constexpr float shade_px = 8.0F;        // granite darkens downwards: scale of that slope
constexpr float hidden_px = -1.2F;      // so near to a nearer stone nothing is believed
constexpr double grip_height_m = 0.06;  // over the handle's rim
constexpr double neighbour_m = 2.5;     // farther stones hide nothing of each other
constexpr double abreast_m = 0.33;      // nor do those that are farther apart across the line of sight
constexpr double most_step_m = 0.06;
constexpr float fewest_pixels = 40.0F;
constexpr float plain_granite = 0.85F;  // of a pixel's light
constexpr int fewest_granite = 8;
constexpr double rock_weight = 100.0;  // of what is known of the granite: some twenty pixels'
constexpr double least_grip = 0.2;     // of a grip's colour: the rest is what shines past it

const NormalTable normal_table;

}  // namespace

StoneModel::StoneModel(const StonePicture& picture, const SharedLook& look, const Eigen::Vector2d& start, int most)
    : source_(picture, start), place_(start), eye_(picture.eye()) {
  gather_stone_pixels(source_, picture.camera, stands(look), most, seen_);
  light_ = in_parts(seen_.light);
  const float middle = seen_.count() > 0 ? seen_.y.mean() : 0.0F;
  shade_ = (seen_.y - middle) / shade_px;
  weight_.setOnes(seen_.count());
  open_.setOnes(seen_.count());
  grip_.setZero(seen_.count());
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

StonePlace StoneModel::stands(const SharedLook& look) const {
  StonePlace stone{place_, look.shape};
  stone.shape.handle_height_m -= rim_lowering_m(look.shape, range_m(), eye_.z());
  return stone;
}

void StoneModel::look_behind(const SharedLook& look) {
  draw(look);
  if (!looked_behind_) {
    vision::look_behind(source_, handle_, body_, seen_);
    behind_ = in_parts(seen_.behind);
    looked_behind_ = true;
  }
  if (coloured_) leave_out_grip(source_, handle_, body_, eye_.z(), handle_colour(), seen_);
  seen_.usable *= open_;
  grip_.setZero(seen_.count());
}

void StoneModel::leave_out(const Foreground& before) {
  for (Eigen::Index i = 0; i < seen_.count(); ++i) {
    if (before.hides(static_cast<int>(seen_.x[i]), static_cast<int>(seen_.y[i]))) open_[i] = 0.0F;
  }
}

void StoneModel::expect_granite(const Light& granite) {
  expected_granite_ = parts_of(granite);
  granite_weight_ = rock_weight;
}

void StoneModel::hide_behind(const KnownStone& nearer, const SharedLook& look) {
  const Eigen::Vector2d apart = nearer.place - place_;
  if (apart.norm() > neighbour_m || (nearer.place - eye_.head<2>()).norm() >= range_m()) return;
  if (std::abs(apart.dot(bearing_of(place_, eye_).right)) > abreast_m) return;
  const StonePlace front{nearer.place, look.shape};
  StonePlace grip = front;
  grip.shape.handle_height_m += grip_height_m;
  grip.shape.handle_thickness_m = grip_height_m;
  draw(look);
  Pixels handle;
  Pixels body;
  handle_px(front, eye_, seen_.sights, handle);
  body_px(front, eye_, seen_.sights, body);
  const Pixels nearest = handle.max(body);
  handle_px(grip, eye_, seen_.sights, handle);
  const Light grips = parts_of(nearer.handle);
  const bool alike = !coloured_ || likeness(colours_.row(0).transpose(), grips) > 0.5;
  for (Eigen::Index i = 0; i < seen_.count(); ++i) {
    if (nearest[i] > hidden_px) seen_.usable[i] = 0.0F;
    if (!(handle[i] > 0.0F)) continue;
    if (likeness(light_.row(i).cast<double>().transpose(), grips) < least_grip) continue;
    if (alike && handle_.px[i] > -1.0F) {
      grip_[i] = 1.0F;
    } else {
      seen_.usable[i] = 0.0F;
    }
  }
}

void StoneModel::Blurred::mix(const DiscDistances& handle_at, const DiscDistances& face_at,
                              const BodyDistances& body_at, float blur_px, float wall_light) {
  const Eigen::Index count = handle_at.px.size();
  for (Pixels* p : {&plate, &handle, &face, &body, &granite, &by_handle, &by_face, &by_body}) p->resize(count);
  const float sharp = 1.0F / blur_px;
  for (Eigen::Index i = 0; i < count; i += 4) {
    const auto blurred = [i, sharp](const Pixels& px, Pixels& share, Pixels& by_px) -> Four {
      Four integral;
      Four density;
      normal_table.at(four(px, i) * sharp, integral, density);
      four(share, i) = integral;
      four(by_px, i) = density * sharp;
      return integral;
    };
    const Four handle_here = blurred(handle_at.px, handle, by_handle);
    const Four face_here = blurred(face_at.px, face, by_face);
    const Four body_here = blurred(body_at.px, body, by_body);
    four(plate, i) = wall_light * handle_here + (1.0F - wall_light) * face_here;
    four(granite, i) = (1.0F - handle_here) * body_here;
  }
}

// Of both colours, which have one blur, it is the same.
void StoneModel::fill_basis(int part) {
  const Blurred& b = blurred(part);
  design_.begin(seen_.count());
  design_.column(0) = b.plate;
  design_.column(1) = b.granite;
  design_.column(2) = b.granite * shade_;
}

// Once for each place and look.
void StoneModel::draw(const SharedLook& look) {
  const auto same = [](const auto& a, const auto& b) { return (a.array() == b.array()).all(); };
  const SharedVector numbers = numbers_of(look);
  if (drawn_ && same(drawn_at_, place_) && same(drawn_with_, numbers)) return;
  const StonePlace stone = stands(look);
  handle_distances(stone, eye_, seen_.sights, handle_);
  face_distances(stone, eye_, seen_.sights, face_);
  body_distances(stone, eye_, seen_.sights, body_);
  const auto wall = static_cast<float>(look.wall_light);
  fine_.mix(handle_, face_, body_, static_cast<float>(look.blur_px), wall);
  coarse_.mix(handle_, face_, body_, static_cast<float>(look.colour_blur_px), wall);
  drawn_ = true;
  drawn_at_ = place_;
  drawn_with_ = numbers;
  looked_behind_ = false;
}

void StoneModel::choose_pixels() {
  const auto own_foot = body_.px > handle_.px && body_.height < foot_height && body_.px < near_foot_px;
  used_ = own_foot.select(0.0F, seen_.usable);
}

void StoneModel::find_colours(const SharedLook& look) {
  draw(look);
  choose_pixels();
  const Pixels weights = weight_ * used_;
  ProductSums::Sums sums;
  for (int part = 0; part < 3; ++part) {
    const Blurred& b = blurred(part);
    if (part < 2) fill_basis(part);
    design_.column(residual_column) = light_.col(part) - (1.0F - b.handle) * (1.0F - b.body) * behind_.col(part);
    design_.sum_up(weights, first_slope, sums, part < 2 ? 0 : basis_columns);
    Eigen::Matrix3d normal = sums.topLeftCorner<3, 3>() + 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = sums.col(residual_column).head<3>();
    normal(2, 2) += 1e-2 * normal(1, 1);
    normal(1, 1) += granite_weight_;
    right[1] += granite_weight_ * expected_granite_[part];
    const Eigen::Vector3d found = normal.ldlt().solve(right);
    if (found.allFinite()) colours_.col(part) = found;
  }
  coloured_ = true;
}

bool StoneModel::enough() const { return used_.sum() >= fewest_pixels; }

double StoneModel::visible() const { return used_.size() == 0 ? 0.0 : static_cast<double>(used_.mean()); }

Light StoneModel::handle_colour() const { return from_parts(colours_.row(0).transpose()); }

int StoneModel::granite_pixels() const {
  return static_cast<int>((fine_.granite > plain_granite && used_ > 0.0F).count());
}

Light StoneModel::granite_colour() const {
  if (granite_pixels() < fewest_granite) return from_parts(colours_.row(1).transpose());
  Light granite;
  for (int channel = 0; channel < 3; ++channel) {
    std::array<float, most_pixels> lights{};
    auto end = lights.begin();
    for (Eigen::Index i = 0; i < seen_.count(); ++i) {
      if (fine_.granite[i] > plain_granite && used_[i] > 0.0F) *end++ = seen_.light(i, channel);
    }
    const auto middle = lights.begin() + (end - lights.begin()) / 2;
    std::nth_element(lights.begin(), middle, end);
    granite[channel] = static_cast<double>(*middle);
  }
  return granite;
}

Light StoneModel::behind_colour() const {
  Light sum = Light::Zero();
  double count = 0.0;
  for (Eigen::Index i = 0; i < seen_.count(); ++i) {
    if (used_[i] == 0.0F || fine_.body[i] > 0.5F || fine_.handle[i] > 0.5F) continue;
    sum += seen_.behind.row(i).cast<double>().matrix().transpose();
    count += 1.0;
  }
  return count > 0.0 ? Light(sum / count) : Light::Zero();
}

}  // namespace hogline::vision
