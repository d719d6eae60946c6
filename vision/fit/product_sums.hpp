// What normal equations are made of: weighed sums, over pixels, of products of their numbers.
#pragma once

#include <Eigen/Core>

#include "vision/fit/stone_region.hpp"

namespace hogline::vision {

/// Some numbers of each pixel, in columns. Nothing is allocated.
class ProductSums {
 public:
  static constexpr int most_columns = 12;
  using Sums = Eigen::Matrix<double, most_columns, most_columns>;

  /// Precondition: at most most_pixels.
  void begin(Eigen::Index pixels);
  /// To be filled, before the sums are asked for.
  auto column(int i) { return columns_.col(i).head(pixels_); }

  /// Of each of the first columns with each other; the rest of the matrix means nothing. One weight for each pixel.
  /// `known`: so many of the first columns, and the weights, are those of the last time: of them `sums` knows all.
  void sum_up(const Pixels& weights, int columns, Sums& sums, int known = 0);

 private:
  static constexpr int lanes = 8;
  static_assert(most_pixels % lanes == 0);

  Eigen::Index pixels_ = 0;
  Eigen::Array<float, most_pixels, most_columns> columns_;
  Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, most_pixels + lanes, 1> weights_;
};

}  // namespace hogline::vision
