#include "vision/fit/product_sums.hpp"

#include <array>
#include <cstring>

namespace hogline::vision {
namespace {

/// Four numbers that stay in a register from pixel to pixel, which Eigen's do not.
using Lanes [[gnu::vector_size(16)]] = float;

Lanes lanes_at(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

}  // namespace

// The last four pixels may be one: the others count nothing.
void ProductSums::begin(Eigen::Index pixels) {
  pixels_ = pixels;
  const Eigen::Index end = (pixels + 3) / 4 * 4;
  columns_.middleRows(pixels, end - pixels).setZero();
}

void ProductSums::sum_up(const Pixels& weights, int columns, Sums& sums) {
  weights_.resize(pixels_ + 3);
  weights_.head(pixels_) = weights;
  weights_.tail<3>().setZero();
  for (int i = 0; i < columns; ++i) {
    int first = 0;
    for (; first + 4 <= i + 1; first += 4) add_products<4>(i, first, sums);
    switch (i + 1 - first) {
      case 3:
        add_products<3>(i, first, sums);
        break;
      case 2:
        add_products<2>(i, first, sums);
        break;
      case 1:
        add_products<1>(i, first, sums);
        break;
      default:
        break;
    }
  }
}

// Of column number `i` with some others.
template <int width>
void ProductSums::add_products(int i, int first, Sums& sums) const {
  std::array<Lanes, width> products{};
  const float* one = columns_.col(i).data();
  const float* others = columns_.col(first).data();
  for (Eigen::Index at = 0; at < pixels_; at += 4) {
    const Lanes weighed = lanes_at(weights_.data() + at) * lanes_at(one + at);
    for (std::size_t k = 0; k < width; ++k) products[k] += weighed * lanes_at(others + k * most_pixels + at);
  }
  for (std::size_t k = 0; k < width; ++k) {
    const int j = first + static_cast<int>(k);
    const float sum = (products[k][0] + products[k][1]) + (products[k][2] + products[k][3]);
    sums(i, j) = sums(j, i) = static_cast<double>(sum);
  }
}

}  // namespace hogline::vision
