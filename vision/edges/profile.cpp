#include "vision/edges/profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::vision {
namespace {

bool inside(const Picture& picture, const Eigen::Vector2d& p) {
  return p.x() >= 0.0 && p.y() >= 0.0 && p.x() < picture.width_px - 1 && p.y() < picture.height_px - 1;
}

bool corners_inside(const Picture& picture, const Cut& cut, const Eigen::Vector2d& tangent) {
  const double side = cut.half_breadth;
  for (const double along : {cut.first_px, cut.last_px}) {
    const Eigen::Vector2d p = cut.centre + along * cut.normal;
    if (!inside(picture, p + side * tangent) || !inside(picture, p - side * tangent)) return false;
  }
  return true;
}

template <int channels>
void add_sample(const Picture& picture, const ResponseCurve& response, float x, float y, std::array<float, 3>& sum) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float u = x - static_cast<float>(column);
  const float v = y - static_cast<float>(row);
  const std::uint8_t* top = picture.pixels + static_cast<std::size_t>(row) * picture.row_bytes + column * channels;
  const std::uint8_t* low = top + picture.row_bytes;
  for (int c = 0; c < channels; ++c) {
    const float a = response.linear(top[c]);
    const float b = response.linear(top[c + channels]);
    const float d = response.linear(low[c]);
    const float e = response.linear(low[c + channels]);
    const float upper = a + u * (b - a);
    sum[static_cast<std::size_t>(c)] += upper + v * (d + u * (e - d) - upper);
  }
}

template <int channels>
void fill(const Picture& picture, const ResponseCurve& response, const Cut& cut, Profile& profile) {
  const Eigen::Vector2f normal = cut.normal.cast<float>();
  const Eigen::Vector2f tangent(-normal.y(), normal.x());
  const Eigen::Vector2f centre = cut.centre.cast<float>();
  const float share = 1.0F / static_cast<float>(2 * cut.half_breadth + 1);
  for (int i = 0; i < profile.count; ++i) {
    const Eigen::Vector2f p = centre + static_cast<float>(profile.position(i)) * normal;
    std::array<float, 3> sum{};
    for (int side = -cut.half_breadth; side <= cut.half_breadth; ++side) {
      const Eigen::Vector2f q = p + static_cast<float>(side) * tangent;
      add_sample<channels>(picture, response, std::max(q.x(), 0.0F), std::max(q.y(), 0.0F), sum);
    }
    for (std::size_t c = 0; c < channels; ++c) profile.light[c][static_cast<std::size_t>(i)] = share * sum[c];
  }
}

}  // namespace

bool sample(const Picture& picture, const ResponseCurve& response, const Cut& cut, Profile& profile) {
  assert((picture.channels == 1 || picture.channels == 3) && cut.step_px > 0.0);
  profile.count = 0;
  profile.channels = picture.channels;
  profile.first_px = cut.first_px;
  profile.step_px = cut.step_px;
  const double samples = std::floor((cut.last_px - cut.first_px) / cut.step_px + 1e-9) + 1.0;
  const Eigen::Vector2d tangent(-cut.normal.y(), cut.normal.x());
  if (!(samples >= 1.0 && samples <= Profile::max_samples) || !corners_inside(picture, cut, tangent)) return false;

  profile.count = static_cast<int>(samples);
  if (picture.channels == 1) {
    fill<1>(picture, response, cut, profile);
  } else {
    fill<3>(picture, response, cut, profile);
  }
  return true;
}

}  // namespace hogline::vision
