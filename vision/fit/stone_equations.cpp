// The normal equations of one stone: StoneModel::linearise and its steps.
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "vision/fit/light_parts.hpp"
#include "vision/fit/stone_model.hpp"

namespace hogline::vision {
namespace {

constexpr float telling_light = 0.12F;  // a pixel that the stone changes by less tells nothing
constexpr float foretold_share = 0.5F;  // of that change may be left unexplained
constexpr int fine_blur = 7;            // numbers of the model: of brightness,
constexpr int coarse_blur = 8;          // and of colours

}  // namespace

/// Normal equations of place and shared numbers.
struct StoneModel::Equations {
  ModelMatrix normal = ModelMatrix::Zero();
  ModelVector right = ModelVector::Zero();

  /// Of the first so many slopes; the one after the last number that all parts share is by number `blur`.
  void add(const ProductSums::Sums& sums, int slopes, int blur);
};

// The colours of this part are eliminated at once: they are its own.
void StoneModel::Equations::add(const ProductSums::Sums& sums, int slopes, int blur) {
  using Slopes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, model_numbers>;
  const Slopes shared = sums.block(0, first_slope, 3, slopes);
  const Eigen::Matrix3d colours = sums.topLeftCorner<3, 3>() + 1e-6 * Eigen::Matrix3d::Identity();
  const Eigen::LDLT<Eigen::Matrix3d> solver(colours);
  const Slopes by_colours = solver.solve(shared);
  const auto number = [blur](int slope) { return slope == fine_blur ? blur : slope; };
  for (int i = 0; i < slopes; ++i) {
    const auto own = sums.col(first_slope + i);
    right[number(i)] += own[residual_column] - by_colours.col(i).dot(sums.col(residual_column).head<3>());
    for (int j = 0; j <= i; ++j)
      normal(number(i), number(j)) += own[first_slope + j] - shared.col(i).dot(by_colours.col(j));
  }
}

void StoneModel::linearise(const SharedLook& look, bool with_shared) {
  find_scale();
  find_colours(look);
  residuals_.resize(seen_.count(), 3);
  for (int part = 0; part < 3; ++part) find_residual(part);

  // Shot noise grows with the light; what is behind was measured with noise, too.
  noise_ = 0.02F + 0.5F * (light_.col(0) + behind_.col(0)).max(0.0F);
  sizes_ = ((residuals_.col(0).square() + colour_weight * (residuals_.col(1).square() + residuals_.col(2).square())) /
            noise_)
               .sqrt();
  weigh();

  Equations equations;
  ProductSums::Sums products;
  for (int part = 0; part < 3; ++part) {
    find_slopes(part, look, with_shared);
    const int slopes = with_shared ? most_slopes : 2;
    const int known = part < 2 ? 0 : basis_columns;
    design_.sum_up((part == 0 ? 1.0F : colour_weight) * weight_, first_slope + slopes, products, known);
    equations.add(products, slopes, part == 0 ? fine_blur : coarse_blur);
  }
  normal_ = equations.normal.selfadjointView<Eigen::Lower>();
  right_ = equations.right;
  left_ = static_cast<double>((weight_ * sizes_.square() * noise_).sum());
  variance_ = left_ / (2.0 * std::max(1.0, static_cast<double>(used_.sum())));
}

void StoneModel::find_residual(int part) {
  const Blurred& b = blurred(part);
  const Eigen::Vector3f colour = colours_.col(part).cast<float>();
  const Pixels stone = colour[1] + shade_ * colour[2];
  const Pixels under = b.body * stone + (1.0F - b.body) * behind_.col(part);
  residuals_.col(part) = light_.col(part) - (b.plate * colour[0] + (1.0F - b.handle) * under);
}

void StoneModel::find_slopes(int part, const SharedLook& look, bool with_shared) {
  const Blurred& b = blurred(part);
  const Eigen::Vector3f colour = colours_.col(part).cast<float>();
  const auto wall = static_cast<float>(look.wall_light);
  const Pixels stone = colour[1] + shade_ * colour[2];
  const Pixels under = b.body * stone + (1.0F - b.body) * behind_.col(part);
  const Pixels handle = (wall * colour[0] - under) * b.by_handle;
  const Pixels face = (1.0F - wall) * colour[0] * b.by_face;
  const Pixels body = (1.0F - b.handle) * (stone - behind_.col(part)) * b.by_body;
  if (part < 2) fill_basis(part);
  const auto slope = [this](int i) { return design_.column(first_slope + i); };
  design_.column(residual_column) = residuals_.col(part);
  slope(0) = handle * handle_.by_x + face * face_.by_x + body * body_.by_x;
  slope(1) = handle * handle_.by_y + face * face_.by_y + body * body_.by_y;
  if (!with_shared) return;
  slope(2) = -handle * handle_.part * handle_.by_height;
  slope(3) = body * body_.by_radius;
  slope(4) = body * body_.by_half_height;
  slope(5) = handle * handle_.by_radius + face * face_.by_radius;
  slope(6) = (b.handle - b.face) * colour[0];
  const auto blur = static_cast<float>(part == 0 ? look.blur_px : look.colour_blur_px);
  slope(7) = -(handle * handle_.px + face * face_.px + body * body_.px) / blur;
}

// Residuals beyond the scale of the last step count less and less.
void StoneModel::weigh() {
  if (scale_ > 0.0) {
    const auto scale = static_cast<float>(scale_);
    weight_ = used_ / (noise_ * (1.0F + (sizes_ / scale).square()));
  } else {
    weight_ = used_ / noise_;
  }
}

// Of the last step's residuals; before the first one there are none.
void StoneModel::find_scale() {
  std::array<float, most_pixels> used;
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < sizes_.size(); ++i) {
    if (used_[i] > 0.0F) used[count++] = sizes_[i];
  }
  if (count == 0) return;
  const auto middle = used.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(used.begin(), middle, used.begin() + static_cast<std::ptrdiff_t>(count));
  scale_ = std::max(0.02, 2.0 * static_cast<double>(*middle));
}

void StoneModel::conclude() {
  const auto plain_left = static_cast<double>((weight_ * residuals_.col(0).square()).sum());
  const PixelColours change = light_ - behind_;
  const auto difference = static_cast<double>(
      (weight_ * (change.col(0).square() + colour_weight * (change.col(1).square() + change.col(2).square()))).sum());
  const auto weights = static_cast<double>(weight_.sum());
  residual_ = weights > 0.0 ? std::sqrt(plain_left / weights) : 0.0;
  explained_ = difference > 0.0 ? 1.0 - left_ / difference : 0.0;
  count_told(change);
}

// Without the weights, which forgive what does not fit.
void StoneModel::count_told(const PixelColours& change) {
  const PixelColours model = change - residuals_;
  const auto squared = [](const PixelColours& p) -> Pixels {
    return p.col(0).square() + colour_weight * (p.col(1).square() + p.col(2).square());
  };
  const Pixels shown = squared(model);
  const Pixels left = squared(residuals_);
  telling_ = handle_told_ = granite_told_ = 0;
  int told = 0;
  for (Eigen::Index i = 0; i < shown.size(); ++i) {
    if (!(used_[i] > 0.0F) || shown[i] < telling_light * telling_light) continue;
    const bool is_told = left[i] < foretold_share * foretold_share * shown[i];
    const bool on_handle = fine_.handle[i] > 0.5F;
    if (is_told && on_handle) ++handle_told_;
    if (grip_[i] > 0.0F) continue;
    ++telling_;
    if (!is_told) continue;
    ++told;
    if (fine_.granite[i] > 0.5F) ++granite_told_;
  }
  told_ = telling_ > 0 ? static_cast<double>(told) / telling_ : 0.0;
}

}  // namespace hogline::vision
