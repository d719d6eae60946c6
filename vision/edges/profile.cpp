#include "vision/edges/profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::vision {

ProfileReader::ProfileReader(const cv::Mat& image, const ResponseCurve& response) : image_(image), response_(response) {
  assert(image.type() == CV_8UC3 || image.type() == CV_8UC1);
}

bool ProfileReader::read(const Eigen::Vector2d& centre, const Eigen::Vector2d& normal, double half_px,
                         Profile& profile) const {
  const int half = static_cast<int>(std::ceil(half_px / Profile::step_px));
  profile.size = std::min(2 * half + 1, Profile::max_samples);
  const Eigen::Vector2d begin = centre + profile.offset_px(0) * normal;
  const Eigen::Vector2d end = centre + profile.offset_px(profile.size - 1) * normal;
  const auto inside = [this](const Eigen::Vector2d& p) {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() < image_.cols - 1 && p.y() < image_.rows - 1;
  };
  if (!inside(begin) || !inside(end)) return false;

  const int channels = image_.channels();
  for (int i = 0; i < profile.size; ++i) {
    const Eigen::Vector2d p = centre + profile.offset_px(i) * normal;
    const int x = static_cast<int>(p.x());
    const int y = static_cast<int>(p.y());
    const auto fx = static_cast<float>(p.x() - x);
    const auto fy = static_cast<float>(p.y() - y);
    const std::uint8_t* upper = image_.ptr<std::uint8_t>(y) + x * channels;
    const std::uint8_t* lower = image_.ptr<std::uint8_t>(y + 1) + x * channels;
    for (int c = 0; c < channels; ++c) {
      const float a = response_.linear(upper[c]) * (1.0F - fx) + response_.linear(upper[c + channels]) * fx;
      const float b = response_.linear(lower[c]) * (1.0F - fx) + response_.linear(lower[c + channels]) * fx;
      profile.light[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)] = a * (1.0F - fy) + b * fy;
    }
    for (int c = channels; c < 3; ++c) {
      profile.light[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)] = 0.0F;
    }
  }
  return true;
}

}  // namespace hogline::vision
