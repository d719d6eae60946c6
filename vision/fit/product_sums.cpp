#include "vision/fit/product_sums.hpp"

#include <array>
#include <cstring>

namespace hogline::vision {
namespace {

/// Eight numbers that stay in registers from pixel to pixel, which Eigen's do not. Their sums do not depend on how many
/// of them a processor takes at once.
using Lanes [[gnu::vector_size(32)]] = float;

[[gnu::always_inline]] inline void take(const float* from, Lanes& lanes) { std::memcpy(&lanes, from, sizeof lanes); }

/// Of `one` with `width` columns that follow each other, weighed.
template <int width>
[[gnu::always_inline]] inline void add_products(const float* weights, const float* one, const float* others,
                                                Eigen::Index pixels, double* sums) {
  std::array<Lanes, width> products{};
  for (Eigen::Index at = 0; at < pixels; at += 8) {
    Lanes weighed, number, other;
    take(weights + at, weighed);
    take(one + at, number);
    weighed *= number;
    for (std::size_t k = 0; k < width; ++k) {
      take(others + k * most_pixels + at, other);
      products[k] += weighed * other;
    }
  }
  for (std::size_t k = 0; k < width; ++k) {
    const Lanes& p = products[k];
    sums[k] = static_cast<double>(((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7])));
  }
}

/// Of `one` with the first `count` columns. For processors with wider registers there is a version of its own; which
/// one it is, is asked before ThreadSanitizer is ready.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
[[gnu::target_clones("avx2", "default")]]
#endif
void add_all(const float* weights, const float* one, const float* columns, int count, Eigen::Index pixels,
             double* sums) {
  int first = 0;
  for (; first + 4 <= count; first += 4) {
    add_products<4>(weights, one, columns + first * most_pixels, pixels, sums + first);
  }
  const float* rest = columns + first * most_pixels;
  if (count - first == 3) add_products<3>(weights, one, rest, pixels, sums + first);
  if (count - first == 2) add_products<2>(weights, one, rest, pixels, sums + first);
  if (count - first == 1) add_products<1>(weights, one, rest, pixels, sums + first);
}

}  // namespace

// The last pixels may be one: the others count nothing.
void ProductSums::begin(Eigen::Index pixels) {
  pixels_ = pixels;
  const Eigen::Index end = (pixels + lanes - 1) / lanes * lanes;
  columns_.middleRows(pixels, end - pixels).setZero();
}

void ProductSums::sum_up(const Pixels& weights, int columns, Sums& sums, int known) {
  weights_.resize(pixels_ + lanes - 1);
  weights_.head(pixels_) = weights;
  weights_.tail<lanes - 1>().setZero();
  std::array<double, most_columns> of_one;
  for (int i = known; i < columns; ++i) {
    add_all(weights_.data(), columns_.col(i).data(), columns_.data(), i + 1, pixels_, of_one.data());
    for (int j = 0; j <= i; ++j) sums(i, j) = sums(j, i) = of_one[static_cast<std::size_t>(j)];
  }
}

}  // namespace hogline::vision
