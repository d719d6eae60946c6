#include "vision/detect/house_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double cell_m = 0.05;
constexpr double nearest_m = 0.2;  // ice ahead of the body's origin
constexpr double deepest_m = 8.0;  // the house ends before
constexpr int block_cells = 20;    // 1 m
constexpr double ice_percentile = 0.7;
constexpr int attempts = 3;
constexpr std::size_t part_step = 5;

double right_of(const ClassifiedLine& line, double ahead_m) {
  return (line.intercept_m - std::sin(line.slope_rad) * ahead_m) / std::cos(line.slope_rad);
}

struct Samples {
  cv::Mat light;   // CV_32FC3 linear, the grid
  cv::Mat inside;  // CV_8UC1
};

Samples sample(const cv::Mat& image, const ResponseCurve& response, const GroundView& view, const HouseArea& area,
               const IceGrid& grid, int rows, int columns) {
  Samples s{cv::Mat(rows, columns, CV_32FC3, cv::Scalar::all(0)), cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0))};
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Eigen::Vector2d g = grid.at(c, r);
      if (area.left && g.x() < right_of(*area.left, g.y()) + 0.05) continue;
      if (area.right && g.x() > right_of(*area.right, g.y()) - 0.05) continue;
      const auto pixel = view.pixel_of_ground(g);
      if (!pixel || !view.lens().in_picture(*pixel, 1.0)) continue;
      const std::uint8_t* p = image.ptr<std::uint8_t>(static_cast<int>(std::lround(pixel->y()))) +
                              static_cast<int>(std::lround(pixel->x())) * image.channels();
      cv::Vec3f& out = s.light.at<cv::Vec3f>(r, c);
      for (int k = 0; k < 3; ++k) out[k] = response.linear(p[image.channels() == 3 ? k : 0]);
      s.inside.at<std::uint8_t>(r, c) = 255;
    }
  }
  return s;
}

// The light of white ice, block by block: a high percentile, which lamps' reflections do not reach, and the best of the
// neighbouring blocks, for those that paint fills.
cv::Mat white_light(const Samples& s) {
  const cv::Size blocks(s.light.cols / block_cells + 1, s.light.rows / block_cells + 1);
  cv::Mat level(blocks, CV_32FC3, cv::Scalar::all(0));
  std::vector<float> values;
  for (int r = 0; r < blocks.height; ++r) {
    for (int c = 0; c < blocks.width; ++c) {
      const cv::Rect area = cv::Rect(c * block_cells, r * block_cells, block_cells, block_cells) &
                            cv::Rect(0, 0, s.light.cols, s.light.rows);
      for (int k = 0; k < 3; ++k) {
        values.clear();
        for (int y = area.y; y < area.br().y; ++y) {
          for (int x = area.x; x < area.br().x; ++x) {
            if (s.inside.at<std::uint8_t>(y, x) != 0) values.push_back(s.light.at<cv::Vec3f>(y, x)[k]);
          }
        }
        if (values.size() < 20) continue;
        const auto place =
            values.begin() + static_cast<std::ptrdiff_t>(ice_percentile * static_cast<double>(values.size()));
        std::nth_element(values.begin(), place, values.end());
        level.at<cv::Vec3f>(r, c)[k] = *place;
      }
    }
  }
  cv::dilate(level, level, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  cv::Mat ice;
  cv::resize(level, ice, s.light.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return ice;
}

// Colour relative to the white ice near by, so that shade and vignetting do not make colours of their own.
cv::Mat relative_to_ice(const Samples& s) {
  const cv::Mat ice = white_light(s);
  cv::Mat relative(s.light.size(), CV_32FC3);
  for (int r = 0; r < s.light.rows; ++r) {
    for (int c = 0; c < s.light.cols; ++c) {
      const cv::Vec3f& light = s.light.at<cv::Vec3f>(r, c);
      const cv::Vec3f& white = ice.at<cv::Vec3f>(r, c);
      for (int k = 0; k < 3; ++k) {
        // The square root spreads dark paints apart and evens the noise out.
        relative.at<cv::Vec3f>(r, c)[k] = std::sqrt(std::clamp(light[k] / std::max(white[k], 1e-4F), 0.0F, 1.0F));
      }
    }
  }
  return relative;
}

int nearest_centre(const cv::Mat& centres, const cv::Vec3f& colour) {
  int nearest = 0;
  float least = std::numeric_limits<float>::max();
  for (int k = 0; k < centres.rows; ++k) {
    const float* centre = centres.ptr<float>(k);
    float square = 0.0F;
    for (int i = 0; i < 3; ++i) square += (colour[i] - centre[i]) * (colour[i] - centre[i]);
    if (square >= least) continue;
    least = square;
    nearest = k;
  }
  return nearest;
}

}  // namespace

std::optional<HouseSegmentation> segment_house(const cv::Mat& image, const ResponseCurve& response,
                                               const GroundView& view, const HouseArea& area) {
  const double depth_m = std::min(deepest_m, area.hog ? area.hog->intercept_m - 0.3 : deepest_m);
  const double half_width_m = rules::max_width_m / 2.0 + 1.5;
  const IceGrid grid{{-half_width_m, nearest_m}, cell_m};
  const int columns = static_cast<int>(2.0 * half_width_m / cell_m) + 1;
  const int rows = static_cast<int>((depth_m - nearest_m) / cell_m);
  if (rows < 2 * block_cells) return std::nullopt;
  const Samples s = sample(image, response, view, area, grid, rows, columns);
  const cv::Mat relative = relative_to_ice(s);

  std::vector<cv::Vec3f> colours;
  std::vector<cv::Point> cells;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (s.inside.at<std::uint8_t>(r, c) == 0) continue;
      colours.push_back(relative.at<cv::Vec3f>(r, c));
      cells.emplace_back(c, r);
    }
  }
  if (colours.size() < 2000) return std::nullopt;

  // Three colours are found in a part of the cells; then every cell goes to the nearest.
  std::vector<cv::Vec3f> part;
  for (std::size_t i = 0; i < colours.size(); i += part_step) part.push_back(colours[i]);
  cv::Mat part_labels;
  cv::Mat centres;
  cv::theRNG().state = 0x9e3779b97f4a7c15ULL;  // the same picture gives the same answer
  cv::kmeans(cv::Mat(static_cast<int>(part.size()), 3, CV_32F, part.data()), 3, part_labels,
             {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 20, 0.005}, attempts, cv::KMEANS_PP_CENTERS, centres);
  std::vector<int> labels;
  labels.reserve(colours.size());
  for (const cv::Vec3f& colour : colours) labels.push_back(nearest_centre(centres, colour));
  std::array<int, 3> count{};
  for (const int label : labels) ++count[static_cast<std::size_t>(label)];
  const auto lightness = [&](int k) { return cv::sum(centres.row(k))[0]; };
  int ice = 0;
  for (int k = 1; k < 3; ++k) ice = lightness(k) > lightness(ice) ? k : ice;
  int outer = -1;
  for (int k = 0; k < 3; ++k) {
    if (k != ice && (outer < 0 || count[static_cast<std::size_t>(k)] > count[static_cast<std::size_t>(outer)]))
      outer = k;
  }
  if (cv::norm(centres.row(outer) - centres.row(ice)) < 0.08) return std::nullopt;

  HouseSegmentation segmentation{grid, cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0))};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (labels[i] == outer) segmentation.outer_ring.at<std::uint8_t>(cells[i]) = 255;
  }
  return segmentation;
}

}  // namespace hogline::vision
