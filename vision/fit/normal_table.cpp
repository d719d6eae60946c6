#include "vision/fit/normal_table.hpp"

#include <cmath>
#include <numbers>

namespace hogline::vision {

NormalTable::NormalTable() {
  for (std::size_t i = 0; i < size; ++i) {
    const double z = static_cast<double>(i) / static_cast<double>(per_unit) - static_cast<double>(reach);
    value_[i].integral = static_cast<float>(0.5 * std::erfc(-z / std::numbers::sqrt2));
    value_[i].density = static_cast<float>(std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi));
  }
  for (std::size_t i = 0; i + 1 < size; ++i) {
    value_[i].integral_rise = value_[i + 1].integral - value_[i].integral;
    value_[i].density_rise = value_[i + 1].density - value_[i].density;
  }
}

}  // namespace hogline::vision
