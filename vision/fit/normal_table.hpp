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
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Value& v = value_[std::min<std::size_t>(static_cast<std::uint32_t>(before[k]), size - 2)];
      integral[k] = v.integral + part[k] * v.integral_rise;
      density[k] = v.density + part[k] * v.density_rise;
    }
  }

 private:
  static constexpr float reach = 4.0F;
  static constexpr float per_unit = 64.0F;
  static constexpr std::size_t size = 514;
  struct Value {
    float integral, integral_rise;  ///< and what it grows by to the next
    float density, density_rise;
  };
  std::array<Value, size> value_{};
};

}  // namespace hogline::vision
