#include "vision/fit/sight_table.hpp"

namespace hogline::vision {
namespace {

std::array<float, 3> weights(float t) {
  return {0.5F * (t - 1.0F) * (t - 2.0F), t * (2.0F - t), 0.5F * t * (t - 1.0F)};
}

}  // namespace

SightTable::SightTable(const SheetCamera& camera, const cv::Rect& area)
    : area_(area),
      by_column_(2.0F / static_cast<float>(area.width - 1)),
      by_row_(2.0F / static_cast<float>(area.height - 1)) {
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d pixel(area.x + 0.5 * i * (area.width - 1), area.y + 0.5 * j * (area.height - 1));
      const auto ray = camera.lens().ray(pixel);
      const Eigen::Vector3d d = ray ? Eigen::Vector3d(camera.eMc().linear() * *ray) : Eigen::Vector3d::Zero();
      ok_ = ok_ && d.z() < -1e-3;
      if (ok_) knots_[static_cast<std::size_t>(3 * j + i)] = (d.head<2>() / -d.z()).cast<float>();
    }
  }
}

void SightTable::find(int x, int y, Eigen::Index at, SightLines& sights) const {
  const float u = static_cast<float>(x - area_.x) * by_column_;
  const float v = static_cast<float>(y - area_.y) * by_row_;
  const std::array<float, 3> wu = weights(u);
  const std::array<float, 3> wv = weights(v);
  const std::array<float, 3> su{(u - 1.5F) * by_column_, (2.0F - 2.0F * u) * by_column_, (u - 0.5F) * by_column_};
  const std::array<float, 3> sv{(v - 1.5F) * by_row_, (2.0F - 2.0F * v) * by_row_, (v - 0.5F) * by_row_};
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();
  Eigen::Vector2f by_column = Eigen::Vector2f::Zero();
  Eigen::Vector2f by_row = Eigen::Vector2f::Zero();
  for (std::size_t j = 0; j < 3; ++j) {
    const Eigen::Vector2f row = wu[0] * knots_[3 * j] + wu[1] * knots_[3 * j + 1] + wu[2] * knots_[3 * j + 2];
    const Eigen::Vector2f turn = su[0] * knots_[3 * j] + su[1] * knots_[3 * j + 1] + su[2] * knots_[3 * j + 2];
    slope += wv[j] * row;
    by_column += wv[j] * turn;
    by_row += sv[j] * row;
  }
  sights.x[at] = slope.x();
  sights.y[at] = slope.y();
  sights.x_by_column[at] = by_column.x();
  sights.y_by_column[at] = by_column.y();
  sights.x_by_row[at] = by_row.x();
  sights.y_by_row[at] = by_row.y();
}

}  // namespace hogline::vision
