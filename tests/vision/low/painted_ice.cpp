#include "tests/vision/low/painted_ice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A pixel on the ice: its middle and how far it reaches to either side in x and y.
struct Footprint {
  Eigen::Vector2d at;
  Eigen::Vector2d half;
  double share(int axis, double begin, double end) const {
    const double lo = std::max(at[axis] - half[axis], begin);
    const double hi = std::min(at[axis] + half[axis], end);
    return std::clamp((hi - lo) / (2.0 * half[axis]), 0.0, 1.0);
  }
  double share_of_disc(const Eigen::Vector2d& tee, double radius) const {
    const Eigen::Vector2d from_tee = at - tee;
    const double r = from_tee.norm();
    const double reach = r > 1e-9 ? (half.cwiseProduct(from_tee.cwiseAbs()) / r).sum() : half.norm();
    return std::clamp((radius - r + reach) / (2.0 * reach), 0.0, 1.0);
  }
};

void lay(Colour& ground, const Colour& colour, double share) {
  ground += static_cast<float>(share) * (colour - ground);
}

void lay_house(Colour& c, const Footprint& p, const Eigen::Vector2d& tee) {
  lay(c, blue, p.share_of_disc(tee, rules::outer_ring_radius_m));
  lay(c, white, p.share_of_disc(tee, rules::middle_ring_radius_m));
  lay(c, red, p.share_of_disc(tee, rules::inner_ring_radius_m));
  lay(c, white, p.share_of_disc(tee, rules::button_radius_m));
}

Colour light_of(const PaintedSheet& sheet, const Footprint& p) {
  Colour c = white;
  const Eigen::Vector2d beyond(0.0, 2.0 * rules::tee_to_hog_m + rules::hog_line_width_m);
  if (sheet.rings) lay_house(c, p, Eigen::Vector2d::Zero());
  if (sheet.house_beyond) lay_house(c, p, beyond);
  for (const CrossLine& line : cross_lines()) {
    const bool hog = line.width_m() > 0.05;
    if (hog && !sheet.hog_line) continue;
    lay(c, hog ? sheet.hog_colour : sheet.line_colour, p.share(1, line.near_edge_y_m, line.far_edge_y_m));
  }
  if (sheet.centre_line) {
    lay(c, sheet.line_colour, p.share(0, -rules::thin_line_width_m / 2.0, rules::thin_line_width_m / 2.0));
  }
  const double half = sheet.width_m / 2.0;
  if (sheet.left_sideline_m) lay(c, sheet.side_colour, p.share(0, -half - *sheet.left_sideline_m, -half));
  if (sheet.right_sideline_m) lay(c, sheet.side_colour, p.share(0, half, half + *sheet.right_sideline_m));
  for (const Patch& patch : sheet.patches) {
    lay(c, patch.colour, p.share(0, patch.x_m[0], patch.x_m[1]) * p.share(1, patch.y_m[0], patch.y_m[1]));
  }
  return c;
}

constexpr int levels = 1 << 16;

// By the level of linear light.
std::vector<std::uint8_t> response_of(double gamma) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i <= levels; ++i) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::lround(255.0 * std::pow(i / static_cast<double>(levels), 1.0 / gamma))));
  }
  return bytes;
}

// A stock of random numbers to draw from.
std::vector<float> noise_of(const PaintedSheet& sheet) {
  std::mt19937_64 random(sheet.seed);
  std::normal_distribution<float> normal(0.0F, static_cast<float>(sheet.noise));
  std::vector<float> noise(10007);
  for (float& n : noise) n = normal(random);
  return noise;
}

}  // namespace

CameraSetup low_camera() {
  CameraSetup setup;
  setup.intrinsics = {.width_px = 1200,
                      .height_px = 900,
                      .model = LensModel::brown_conrady,
                      .fx_px = 525.0,
                      .fy_px = 525.0,
                      .cx_px = 597.0,
                      .cy_px = 452.0,
                      .distortion = {-0.11, 0.011, -0.0002, 0.0003, 0.0}};
  setup.mount = {.x_m = 0.45, .y_m = 0.0, .z_m = 0.5, .roll_rad = 0.0, .pitch_rad = 20.0 * degree, .yaw_rad = 0.0};
  setup.gamma = 2.2;
  setup.sheet.sideline = SidelineKind::unknown;
  setup.ice = {.paint_depth_m = 0.006, .refractive_index = 1.309};
  return setup;
}

cv::Mat paint(const CameraSetup& setup, const PaintedSheet& sheet) {
  Mount mount = setup.mount;
  mount.pitch_rad += sheet.lean_rad;
  const SheetCamera camera(Lens(setup.intrinsics), eMb(sheet.body) * bMc(mount), setup.ice);
  const int width = setup.intrinsics.width_px;
  const int height = setup.intrinsics.height_px;
  std::vector<std::optional<Eigen::Vector2d>> above(static_cast<std::size_t>(width));
  const std::vector<std::uint8_t> response = response_of(setup.gamma);
  const std::vector<float> noise = noise_of(sheet);
  std::mt19937_64 random(sheet.seed);
  cv::Mat image(height, width, CV_8UC3);
  for (int v = 0; v < height; ++v) {
    std::optional<Eigen::Vector2d> before;
    for (int u = 0; u < width; ++u) {
      const auto at = camera.paint_at({static_cast<double>(u), static_cast<double>(v)});
      auto& up = above[static_cast<std::size_t>(u)];
      Colour light(0.03F, 0.03F, 0.03F);
      if (at && before && up && (*up - *at).norm() < 20.0) {
        const Eigen::Vector2d half = 0.5 * ((*at - *before).cwiseAbs() + (*at - *up).cwiseAbs());
        light = light_of(sheet, {*at, half.cwiseMax(1e-6)});
      }
      before = at;
      up = at;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(v, u);
      const std::size_t first = random() % (noise.size() - 2);
      for (std::size_t k = 0; k < 3; ++k) {
        const float linear = std::clamp(light[static_cast<int>(k)] + noise[first + k], 0.0F, 1.0F);
        pixel[static_cast<int>(k)] = response[static_cast<std::size_t>(linear * static_cast<float>(levels))];
      }
    }
  }
  return image;
}

}  // namespace hogline::vision::testing
