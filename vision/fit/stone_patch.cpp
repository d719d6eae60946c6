#include "vision/fit/stone_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/fit/sight_table.hpp"

namespace hogline::vision {
namespace {

constexpr double margin_px = 3.0;
constexpr float band_px = 3.5F;  // about an outline: blur, and what the fit may move

cv::Rect bounds_of(const SheetCamera& camera, const StonePlace& stone) {
  const Eigen::Vector3d eye = camera.eMc().translation();
  const Bearing bearing = bearing_of(stone.place, eye);
  if (bearing.range_m < 2.0 * stone.shape.body_radius_m) return {};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12.0;
    for (const Eigen::Vector3d& p :
         {body_outline_point(stone.place, stone.shape, eye, angle),
          circle_point(stone.place, bearing, stone.shape.handle_radius_m, stone.shape.handle_height_m, angle)}) {
      const auto pixel = camera.project(p);
      if (!pixel) return {};
      low = low.cwiseMin(*pixel);
      high = high.cwiseMax(*pixel);
    }
  }
  const cv::Point a(static_cast<int>(std::floor(low.x() - margin_px)),
                    static_cast<int>(std::floor(low.y() - margin_px)));
  const cv::Point b(static_cast<int>(std::ceil(high.x() + margin_px)),
                    static_cast<int>(std::ceil(high.y() + margin_px)));
  const Intrinsics& k = camera.lens().intrinsics();
  return cv::Rect(a, b) & cv::Rect(0, 0, k.width_px, k.height_px);
}

/// Pixels that are tried, some hundred at a time; those about an outline are kept.
class Sieve {
 public:
  Sieve(const StonePlace& stone, const Eigen::Vector3d& eye, StonePixels& kept)
      : stone_(stone), eye_(eye), kept_(kept) {
    tried_.resize(most_pixels);
    resize(kept_, most_pixels);
  }

  void add(int x, int y, const SightTable::Row& sights) {
    columns_[static_cast<std::size_t>(waiting_)] = x;
    rows_[static_cast<std::size_t>(waiting_)] = y;
    sights.find(x, waiting_, tried_);
    if (++waiting_ == most_pixels) settle();
  }

  /// False when more were about an outline than can be kept.
  bool finish() {
    settle();
    resize(kept_, count_);
    return !full_;
  }

 private:
  static void resize(StonePixels& p, Eigen::Index count) {
    const auto shrink = [count](Pixels& numbers) { numbers.conservativeResize(count); };
    for (Pixels* n : {&p.sights.x, &p.sights.y, &p.sights.x_by_column, &p.sights.x_by_row, &p.sights.y_by_column,
                      &p.sights.y_by_row, &p.x, &p.y, &p.usable}) {
      shrink(*n);
    }
    p.light.conservativeResize(count, 3);
    p.behind.conservativeResize(count, 3);
  }

  void settle() {
    tried_.resize(waiting_);
    handle_px(stone_, eye_, tried_, handle_);
    body_px(stone_, eye_, tried_, body_);
    tried_.resize(most_pixels);
    for (int i = 0; i < waiting_; ++i) {
      const float handle = handle_[i];
      const float body = body_[i];
      if (std::abs(handle) > band_px && std::abs(body) > band_px) continue;
      if (std::max(handle, body) < -band_px) continue;
      full_ = count_ == most_pixels;
      if (full_) break;
      keep(i);
    }
    waiting_ = 0;
  }

  void keep(int i) {
    kept_.x[count_] = static_cast<float>(columns_[static_cast<std::size_t>(i)]);
    kept_.y[count_] = static_cast<float>(rows_[static_cast<std::size_t>(i)]);
    SightLines& s = kept_.sights;
    s.x[count_] = tried_.x[i];
    s.y[count_] = tried_.y[i];
    s.x_by_column[count_] = tried_.x_by_column[i];
    s.x_by_row[count_] = tried_.x_by_row[i];
    s.y_by_column[count_] = tried_.y_by_column[i];
    s.y_by_row[count_] = tried_.y_by_row[i];
    ++count_;
  }

  const StonePlace& stone_;
  Eigen::Vector3d eye_;
  StonePixels& kept_;
  SightLines tried_;
  Pixels handle_;
  Pixels body_;
  std::array<int, most_pixels> columns_{};
  std::array<int, most_pixels> rows_{};
  int waiting_ = 0;
  Eigen::Index count_ = 0;
  bool full_ = false;
};

}  // namespace

PatchSource::PatchSource(const StonePicture& picture, const Eigen::Vector2d& place)
    : last_x_(static_cast<float>(picture.bgr.cols - 1)),
      last_y_(static_cast<float>(picture.bgr.rows - 1)),
      bgr_(&picture.bgr) {
  const auto pixel = picture.camera.project({place.x(), place.y(), picture.shape.handle_height_m});
  const std::array<float, 3> white = pixel ? picture.ice.at(pixel->x(), pixel->y()) : std::array{1.0F, 1.0F, 1.0F};
  for (std::size_t k = 0; k < 3; ++k) {
    Eigen::Array<float, 256, 1> levels;
    for (int i = 0; i < 256; ++i) levels[i] = picture.response.linear(static_cast<std::uint8_t>(i));
    levels /= white[k];
    for (std::size_t i = 0; i < 256; ++i) {
      level_[k][i] = Eigen::Array4f::Zero();
      level_[k][i][static_cast<Eigen::Index>(k)] = levels[static_cast<Eigen::Index>(i)];
    }
  }
}

bool PatchSource::at(float x, float y, Eigen::Array3f& light) const {
  Eigen::Array4f sampled;
  if (!sample(x, y, sampled)) return false;
  light = sampled.head<3>();
  return true;
}

bool PatchSource::mean_of_three(float x, float y, float step_x, float step_y, Eigen::Array3f& mean) const {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int i = 0; i < 3; ++i) {
    const auto step = static_cast<float>(i);
    Eigen::Array4f light;
    if (!nearest(x + step * step_x, y + step * step_y, light)) return false;
    sum += light / 3.0F;
  }
  mean = sum.head<3>();
  return true;
}

namespace {

/// Every `keep`th pixel of the area, in a slanting pattern; false when there are too many.
bool sift(const SheetCamera& camera, const StonePlace& stone, const cv::Rect& area, int keep, StonePixels& pixels) {
  Sieve sieve(stone, camera.eMc().translation(), pixels);
  if (area.width >= 6 && area.height >= 6) {
    const SightTable sights(camera, area);
    for (int y = area.y; y < area.br().y && sights.ok(); ++y) {
      const int first = area.x + (keep - (area.x + 3 * y) % keep) % keep;
      const SightTable::Row row = sights.row(y);
      for (int x = first; x < area.br().x; x += keep) sieve.add(x, y, row);
    }
  }
  return sieve.finish();
}

}  // namespace

void gather_stone_pixels(const PatchSource& source, const SheetCamera& camera, const StonePlace& stone, int most,
                         StonePixels& pixels) {
  const cv::Rect area = bounds_of(camera, stone);
  int keep = std::max(1, area.area() / (3 * most));  // about a third of the rectangle lies near an outline
  while (!sift(camera, stone, area, keep, pixels)) ++keep;
  for (Eigen::Index i = 0; i < pixels.count(); ++i) {
    pixels.light.row(i) = source.at(static_cast<int>(pixels.x[i]), static_cast<int>(pixels.y[i])).transpose();
  }
}

}  // namespace hogline::vision
