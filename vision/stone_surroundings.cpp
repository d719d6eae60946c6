#include "vision/stone_surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr std::array<double, 4> before_m{0.25, 0.35, 0.5, 0.65};       // the foot, beyond the stone's own shadow
constexpr std::array<double, 5> over_m{0.24, 0.30, 0.36, 0.44, 0.54};  // the ice; a grip ends at 0.20
constexpr std::array<double, 3> beside_m{-0.05, 0.0, 0.05};
constexpr double least_alike = 0.06;  // noise
constexpr double most_share = 0.65;
constexpr double covers_m = 0.16;  // a nearer stone covers what lies so near to it across

/// How many of some places look like a colour.
class Tally {
 public:
  Tally(const StonePicture& picture, const Light& colour, double alike) : picture_(picture), colour_(colour) {
    reach_ = std::max(least_alike, alike * (Light::Ones() - colour).norm());
  }
  void ask(const Eigen::Vector3d& place) {
    const auto pixel = picture_.camera.project(place);
    if (!pixel || !picture_.camera.lens().in_picture(*pixel, 1.0)) return;
    const int x = static_cast<int>(std::lround(pixel->x()));
    const int y = static_cast<int>(std::lround(pixel->y()));
    const std::uint8_t* p = picture_.bgr.ptr<std::uint8_t>(y) + 3 * x;
    const auto white = picture_.ice.at(x, y);
    Light light;
    for (int k = 0; k < 3; ++k) {
      light[k] = static_cast<double>(picture_.response.linear(p[k]) / white[static_cast<std::size_t>(k)]);
    }
    ++asked_;
    alike_ += (light - colour_).norm() < reach_ ? 1 : 0;
  }
  bool mostly() const { return asked_ >= 3 && alike_ > most_share * asked_; }

 private:
  const StonePicture& picture_;
  Light colour_;
  double reach_;
  int asked_ = 0;
  int alike_ = 0;
};

}  // namespace

StoneSurroundings surroundings_of(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer, double alike) {
  const Eigen::Vector2d& place = stone.fit.place;
  const Bearing bearing = bearing_of(place, picture.eye());
  const bool covered = std::any_of(nearer.begin(), nearer.end(), [&](const KnownStone& n) {
    const Eigen::Vector2d off = n.place - place;
    return off.dot(bearing.away) < -0.5 * picture.shape.body_radius_m &&
           std::abs(off.dot(bearing.right)) < picture.shape.body_radius_m + covers_m;
  });
  Tally below(picture, stone.fit.granite, alike);
  Tally above(picture, stone.fit.handle, alike);
  for (const double right_m : beside_m) {
    for (const double m : before_m) {
      const Eigen::Vector2d p = place - m * bearing.away + right_m * bearing.right;
      below.ask({p.x(), p.y(), 0.0});
    }
    for (const double m : over_m) {
      const Eigen::Vector2d p = place + right_m * bearing.right;
      above.ask({p.x(), p.y(), m});
    }
  }
  return {!covered && below.mostly(), above.mostly()};
}

}  // namespace hogline::vision
