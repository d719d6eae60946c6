// The normal distribution's integral and density, tabulated: how an edge looks through a blur.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

namespace hogline::vision {

class NormalTable {
 public:
  NormalTable();

  /// At z standard deviations, of four; within 1e-5. What is no number gives none.
  void at(const Eigen::Array4f& z, Eigen::Array4f& integral, Eigen::Array4f& density) const {
    const Eigen::Array4f u = (z.max(-reach).min(reach) + reach) * per_unit;
    const Eigen::Array4i before = u.cast<int>();
    const Eigen::Array4f part = u - before.cast<float>();
    Eigen::Matrix4f of_each;
    for (Eigen::Index k = 0; k < 4; ++k) {
      of_each.col(k) = value_[std::min<std::size_t>(static_cast<std::uint32_t>(before[k]), size - 2)];
    }
    of_each.transposeInPlace();
    integral = of_each.col(0).array() + part * of_each.col(1).array();
    density = of_each.col(2).array() + part * of_each.col(3).array();
  }

 private:
  static constexpr float reach = 4.0F;
  static constexpr float per_unit = 64.0F;
  static constexpr std::size_t size = 514;
  std::array<Eigen::Vector4f, size> value_;  ///< integral, what it grows by to the next, density, what that grows by
};

}  // namespace hogline::vision
