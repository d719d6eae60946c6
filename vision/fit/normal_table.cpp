#include "vision/fit/normal_table.hpp"

#include <cmath>
#include <numbers>

namespace hogline::vision {

NormalTable::NormalTable() {
  for (std::size_t i = 0; i < size; ++i) {
    const double z = static_cast<double>(i) / static_cast<double>(per_unit) - static_cast<double>(reach);
    value_[i] = {static_cast<float>(0.5 * std::erfc(-z / std::numbers::sqrt2)), 0.0F,
                 static_cast<float>(std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi)), 0.0F};
  }
  for (std::size_t i = 0; i + 1 < size; ++i) {
    value_[i][1] = value_[i + 1][0] - value_[i][0];
    value_[i][3] = value_[i + 1][2] - value_[i][2];
  }
}

}  // namespace hogline::vision
