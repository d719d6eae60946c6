#include "vision/fit/sight_table.hpp"

namespace hogline::vision {
namespace {

/// The polynomial through three values at 0, 1 and 2: its terms, of rising order.
std::array<Eigen::Array2f, 3> through(const Eigen::Array2f& a, const Eigen::Array2f& b, const Eigen::Array2f& c) {
  return {a, 2.0F * b - 1.5F * a - 0.5F * c, 0.5F * (a + c) - b};
}

}  // namespace

SightTable::SightTable(const SheetCamera& camera, const cv::Rect& area)
    : area_(area),
      by_column_(2.0F / static_cast<float>(area.width - 1)),
      by_row_(2.0F / static_cast<float>(area.height - 1)) {
  std::array<std::array<Eigen::Array2f, 3>, 3> rows;  // by row, then by the column's order
  for (std::size_t j = 0; j < 3; ++j) {
    std::array<Eigen::Array2f, 3> knots;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d pixel(area.x + 0.5 * static_cast<double>(i) * (area.width - 1),
                                  area.y + 0.5 * static_cast<double>(j) * (area.height - 1));
      const auto ray = camera.lens().ray(pixel);
      const Eigen::Vector3d d = ray ? Eigen::Vector3d(camera.eMc().linear() * *ray) : Eigen::Vector3d::Zero();
      ok_ = ok_ && d.z() < -1e-3;
      knots[i] = ok_ ? Eigen::Array2f((d.head<2>() / -d.z()).cast<float>()) : Eigen::Array2f::Zero();
    }
    rows[j] = through(knots[0], knots[1], knots[2]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto by_row = through(rows[0][i], rows[1][i], rows[2][i]);
    for (std::size_t j = 0; j < 3; ++j) terms_[j][i] = by_row[j];
  }
}

SightTable::Row SightTable::row(int y) const {
  const float v = static_cast<float>(y - area_.y) * by_row_;
  Row row;
  row.left_ = area_.x;
  row.by_column_ = by_column_;
  for (std::size_t i = 0; i < 3; ++i) {
    row.terms_[i].head<2>() = terms_[0][i] + v * (terms_[1][i] + v * terms_[2][i]);
    row.terms_[i].tail<2>() = by_row_ * (terms_[1][i] + 2.0F * v * terms_[2][i]);
  }
  return row;
}

}  // namespace hogline::vision
