#include "vision/detect/edge_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

// Half-size picture of the darkest colour, from `top` downwards.
cv::Mat darkest_half(const cv::Mat& image, int top) {
  const cv::Mat lower = image.rowRange(top, image.rows);
  cv::Mat half;
  cv::resize(lower, half, cv::Size(lower.cols / 2, lower.rows / 2), 0.0, 0.0, cv::INTER_AREA);
  if (half.channels() == 1) return half;
  cv::Mat darkest(half.size(), CV_8UC1);
  for (int r = 0; r < half.rows; ++r) {
    const std::uint8_t* in = half.ptr<std::uint8_t>(r);
    std::uint8_t* out = darkest.ptr<std::uint8_t>(r);
    for (int c = 0; c < half.cols; ++c, in += 3) out[c] = std::min({in[0], in[1], in[2]});
  }
  return darkest;
}

// The median size of the gradient in one block.
int middle_gradient(const cv::Mat& block) {
  std::array<int, 1024> histogram{};
  int count = 0;
  for (int r = 0; r < block.rows; r += 4) {
    const std::int16_t* row = block.ptr<std::int16_t>(r);
    for (int c = 0; c < block.cols; c += 3, ++count)
      ++histogram[static_cast<std::size_t>(std::min(std::abs(int{row[c]}), 1023))];
  }
  int seen = 0;
  std::size_t median = 0;
  while (median + 1 < histogram.size() && (seen += histogram[median]) * 2 < count) ++median;
  return static_cast<int>(median);
}

// A robust standard deviation of the gradient where there is nothing but noise. Ice is rougher than what may stand
// before it, so the rougher half of the picture's blocks tells.
double gradient_noise(const cv::Mat& dx) {
  constexpr int across = 8;
  constexpr int down = 6;
  std::vector<int> blocks;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const cv::Range rows(j * dx.rows / down, (j + 1) * dx.rows / down);
      const cv::Range columns(i * dx.cols / across, (i + 1) * dx.cols / across);
      if (rows.size() > 4 && columns.size() > 4) blocks.push_back(middle_gradient(dx(rows, columns)));
    }
  }
  if (blocks.empty()) return 0.0;
  const auto rough = blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() * 3 / 4);
  std::nth_element(blocks.begin(), rough, blocks.end());
  return *rough / 0.6745;
}

struct Gradient {
  const cv::Mat& dx;
  const cv::Mat& dy;
  int at(int r, int c) const {
    return std::abs(int{dx.ptr<std::int16_t>(r)[c]}) + std::abs(int{dy.ptr<std::int16_t>(r)[c]});
  }
};

// Largest across the edge, in the nearer of the two axes.
bool is_ridge(const Gradient& g, int r, int c, int strength) {
  const bool steep = std::abs(int{g.dx.ptr<std::int16_t>(r)[c]}) > std::abs(int{g.dy.ptr<std::int16_t>(r)[c]});
  const int before = steep ? g.at(r, c - 1) : g.at(r - 1, c);
  const int after = steep ? g.at(r, c + 1) : g.at(r + 1, c);
  return strength > before && strength >= after;
}

// The half pixel's parabola along the dominant axis.
Eigen::Vector2d refined(const Gradient& g, int r, int c, int strength) {
  const bool steep = std::abs(int{g.dx.ptr<std::int16_t>(r)[c]}) > std::abs(int{g.dy.ptr<std::int16_t>(r)[c]});
  const int before = steep ? g.at(r, c - 1) : g.at(r - 1, c);
  const int after = steep ? g.at(r, c + 1) : g.at(r + 1, c);
  const double curvature = before - 2.0 * strength + after;
  const double shift = curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
  return steep ? Eigen::Vector2d(c + shift, r) : Eigen::Vector2d(c, r + shift);
}

// Fills the undistorted and the ground parts; false where the point lies on no ice of interest.
bool complete(EdgePoint& point, const Eigen::Vector2d& gradient, const GroundView& view,
              const EdgePointOptions& options) {
  const Eigen::Vector2d along = Eigen::Vector2d(-gradient.y(), gradient.x()).normalized();
  const auto a = view.plane(point.pixel - 2.0 * along);
  const auto b = view.plane(point.pixel + 2.0 * along);
  if (!a || !b) return false;
  point.plane = 0.5 * (*a + *b);
  const auto ga = view.ground_of_plane(*a);
  const auto gb = view.ground_of_plane(*b);
  if (!ga || !gb) return false;
  point.ground = 0.5 * (*ga + *gb);
  if (point.ground.y() > options.range_m || std::abs(point.ground.x()) > options.half_width_m) return false;
  const auto lighter = view.plane(point.pixel + 2.0 * gradient.normalized());
  if (!lighter) return false;
  const auto normal = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& side) {
    const Eigen::Vector2d t = (to - from).normalized();
    const Eigen::Vector2d n(-t.y(), t.x());
    return n.dot(side - from) >= 0.0 ? n : Eigen::Vector2d(-n);
  };
  point.plane_normal = normal(*a, *b, *lighter);
  const auto ground_lighter = view.ground_of_plane(*lighter);
  if (!ground_lighter) return false;
  point.ground_normal = normal(*ga, *gb, *ground_lighter);
  return true;
}

}  // namespace

std::vector<EdgePoint> find_edge_points(const cv::Mat& image, const GroundView& view, const EdgePointOptions& options) {
  const int top = view.first_row(options.range_m) & ~1;
  if (image.rows - top < 16) return {};
  return find_edge_points(darkest_half(image, top), top, view, options);
}

std::vector<EdgePoint> find_edge_points(const cv::Mat& half, int top, const GroundView& view,
                                        const EdgePointOptions& options) {
  std::vector<EdgePoint> points;
  cv::Mat dx;
  cv::Mat dy;
  cv::Sobel(half, dx, CV_16S, 1, 0);
  cv::Sobel(half, dy, CV_16S, 0, 1);
  const int threshold = static_cast<int>(std::max(5.0 * gradient_noise(dx), 24.0));

  const Gradient gradient{dx, dy};
  for (int r = 1; r < dx.rows - 1; ++r) {
    for (int c = 1; c < dx.cols - 1; ++c) {
      const int strength = gradient.at(r, c);
      if (strength < threshold || !is_ridge(gradient, r, c, strength)) continue;
      EdgePoint point;
      // A half-size pixel's centre lies between two pixels.
      point.pixel = 2.0 * refined(gradient, r, c, strength) + Eigen::Vector2d(0.5, top + 0.5);
      const Eigen::Vector2d towards_light(dx.ptr<std::int16_t>(r)[c], dy.ptr<std::int16_t>(r)[c]);
      if (complete(point, towards_light, view, options)) points.push_back(point);
    }
  }
  return points;
}

}  // namespace hogline::vision
