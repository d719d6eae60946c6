// The normal distribution's integral and density, tabulated: how an edge looks through a blur.
#pragma once

#include <array>

namespace hogline::vision {

class NormalTable {
 public:
  NormalTable();

  /// At z standard deviations; within 1e-5.
  void at(float z, float& integral, float& density) const {
    const float u = (z < -reach ? 0.0F : z > reach ? 2.0F * reach : z + reach) * per_unit;
    const auto i = static_cast<std::size_t>(u);
    const float f = u - static_cast<float>(i);
    integral = value_[i].integral + f * (value_[i + 1].integral - value_[i].integral);
    density = value_[i].density + f * (value_[i + 1].density - value_[i].density);
  }

 private:
  static constexpr float reach = 4.0F;
  static constexpr float per_unit = 64.0F;
  static constexpr std::size_t size = 514;
  struct Value {
    float integral, density;
  };
  std::array<Value, size> value_{};
};

}  // namespace hogline::vision
