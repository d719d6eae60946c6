#include "tests/support/random_scene.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::testing {
namespace {

using hw::sim::Colour;
using hw::sim::Divider;

constexpr double degree = std::numbers::pi / 180.0;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(hw::sim::mixed_bits(seed)) {}
  double uniform(double from, double to) {
    return from + (to - from) * hw::sim::uniform_of(hw::sim::mixed_bits(seed_ + ++drawn_));
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  int upto(int most) { return static_cast<int>(uniform(0.0, most + 1.0)); }
  template <typename T, std::size_t n>
  const T& one_of(const std::array<T, n>& all) {
    return all[static_cast<std::size_t>(upto(static_cast<int>(n) - 1))];
  }

 private:
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

const Colour blue{0.02F, 0.07F, 0.45F};
const Colour light_blue{0.10F, 0.30F, 0.65F};
const Colour red{0.55F, 0.02F, 0.02F};
const Colour green{0.02F, 0.28F, 0.08F};
const Colour black{0.02F, 0.02F, 0.02F};
const Colour yellow{0.75F, 0.58F, 0.03F};
const Colour orange{0.75F, 0.25F, 0.02F};
const Colour purple{0.20F, 0.03F, 0.35F};
const Colour white{0.88F, 0.89F, 0.90F};
const Colour grey{0.35F, 0.35F, 0.36F};

Colour dimmed(const Colour& colour, double share) {
  const auto s = static_cast<float>(share);
  return {s * colour.red, s * colour.green, s * colour.blue};
}

// As clubs paint them: a dark or bright outer ring, white, another colour within, a white or coloured button.
std::array<Colour, 4> rings(Dice& dice) {
  const std::array<Colour, 8> outer{blue, red, green, light_blue, black, purple, orange, yellow};
  const std::array<Colour, 7> inner{red, blue, green, yellow, light_blue, black, purple};
  std::array<Colour, 4> all{dice.one_of(outer), white, dice.one_of(inner), white};
  if (dice.chance(0.15)) all[1] = yellow;
  if (dice.chance(0.2)) all[3] = dice.chance(0.5) ? black : blue;
  return all;
}

void dress_sheet(Dice& dice, RandomScene& scene) {
  const std::array<Colour, 5> hog_lines{red, black, blue, green, orange};
  const std::array<Colour, 4> thin_lines{black, blue, red, grey};
  const std::array<Colour, 5> dividers{black, blue, red, yellow, grey};
  auto& sheet = scene.rink.sheet;
  sheet.width_m = dice.uniform(4.35, 4.98);
  sheet.divider = dice.one_of(std::array<Divider, 4>{Divider::line, Divider::bumper, Divider::rope, Divider::none});
  sheet.divider_width_m = dice.uniform(0.02, 0.065);
  sheet.divider_height_m = dice.uniform(0.04, 0.12);
  sheet.rope_sway_m = dice.uniform(0.005, 0.03);
  sheet.rope_wavelength_m = dice.uniform(3.0, 8.0);
  sheet.neighbours = dice.chance(0.8);
  sheet.neighbour_gap_m = dice.uniform(0.08, 0.3);
  sheet.rings = rings(dice);
  sheet.ice = dimmed({0.95F, 0.96F, 0.98F}, dice.uniform(0.75, 0.97));
  sheet.hog_line = dice.one_of(hog_lines);
  sheet.thin_lines = dice.one_of(thin_lines);
  sheet.divider_colour = dice.one_of(dividers);
  sheet.courtesy_lines = dice.chance(0.5);
  sheet.hacks = dice.chance(0.5);
  for (int k = dice.upto(2); k > 0; --k) {
    sheet.logos.push_back({dice.uniform(-1.6, 1.6), dice.uniform(2.4, 5.6), dice.uniform(0.3, 1.2),
                           dice.uniform(0.3, 1.2), dice.one_of(dividers)});
  }
  scene.rink.light.level = dice.uniform(0.45, 0.85);
  scene.rink.light.falloff_per_m = dice.uniform(-0.05, 0.05);
  scene.rink.light.vignetting = dice.uniform(0.0, 0.35);
  scene.rink.light.lamp_gloss = dice.uniform(0.0, 0.8);
  scene.rink.light.roughness_rad = dice.uniform(0.01, 0.03);
}

void place_robot(Dice& dice, const SceneMix& mix, RandomScene& scene) {
  auto& setup = scene.setup;
  setup.intrinsics = {1600,
                      1200,
                      vision::LensModel::brown_conrady,
                      dice.uniform(720.0, 860.0),
                      0.0,
                      dice.uniform(790.0, 810.0),
                      dice.uniform(590.0, 610.0),
                      {dice.uniform(-0.14, -0.06), dice.uniform(0.005, 0.016), 0.0003, -0.0002, 0.0}};
  setup.intrinsics.fy_px = setup.intrinsics.fx_px * dice.uniform(0.998, 1.002);
  setup.mount = {dice.uniform(0.1, 0.3),           dice.uniform(-0.05, 0.05),         dice.uniform(1.85, 2.1),
                 dice.uniform(-0.5, 0.5) * degree, dice.uniform(25.0, 31.0) * degree, dice.uniform(-1.0, 1.0) * degree};
  setup.gamma = dice.chance(0.3) ? 2.2 : 1.0;
  setup.ice = {dice.uniform(0.003, 0.012), 1.309};
  scene.true_mount = setup.mount;
  scene.true_mount.pitch_rad += dice.uniform(-mix.most_tilt_rad, mix.most_tilt_rad);
  scene.true_mount.roll_rad += 0.5 * dice.uniform(-mix.most_tilt_rad, mix.most_tilt_rad);
  const PlanarPose body{dice.uniform(-0.5, 0.5), dice.uniform(-4.7, -2.5), dice.uniform(-9.0, 9.0) * degree};
  scene.eMc = vision::eMb(body) * vision::bMc(scene.true_mount);
  scene.body = vision::planar_body(scene.eMc, setup.mount);
}

// At least this far from the lens along the sheet: what stands nearer hides all.
constexpr double clear_of_camera_m = 1.6;

void place_things(Dice& dice, const SceneMix& mix, RandomScene& scene) {
  const double first_y_m = scene.body.y_m + clear_of_camera_m;
  const std::array<Colour, 4> plates{red, yellow, blue, green};
  const Colour first = dice.one_of(plates);
  const Colour second = dice.one_of(plates);
  for (int k = dice.upto(mix.most_stones); k > 0; --k) {
    hw::sim::StoneLook stone;
    stone.x_m = dice.uniform(-2.0, 2.0);
    stone.y_m = dice.uniform(std::max(first_y_m, -1.8), dice.chance(0.6) ? 1.9 : 6.3);
    stone.handle_rad = dice.uniform(-3.1, 3.1);
    stone.plate = dice.chance(0.5) ? first : second;
    stone.granite = dimmed({0.4F, 0.4F, 0.41F}, dice.uniform(0.2, 1.0));
    scene.exposure.stones.push_back(stone);
  }
  const std::array<Colour, 7> clothes{black, blue, red, green, grey, white, purple};
  for (int k = dice.upto(mix.most_people); k > 0; --k) {
    hw::sim::PersonLook person;
    person.y_m = dice.uniform(first_y_m, 8.0);
    person.x_m = dice.uniform(-2.6, 2.6);
    person.facing_rad = dice.uniform(-3.1, 3.1);
    person.height_m = dice.uniform(1.55, 1.95);
    person.stride_m = dice.uniform(0.0, 0.4);
    person.jacket = dice.one_of(clothes);
    person.trousers = dice.one_of(clothes);
    scene.exposure.people.push_back(person);
  }
}

void choose_sensor(Dice& dice, const SceneMix& mix, RandomScene& scene) {
  scene.sensor.gamma = scene.setup.gamma;
  scene.sensor.full_scale_electrons = dice.uniform(4000.0, 15000.0);
  scene.sensor.read_noise_electrons = dice.uniform(3.0, 12.0);
  scene.sensor.pebble_contrast = dice.uniform(0.0, 0.02);
  scene.sensor.blur_sigma_px = mix.colour_mosaic ? dice.uniform(0.45, 0.7) : dice.uniform(0.45, 0.9);
}

std::string words(const RandomScene& scene) {
  const std::array<const char*, 4> dividers{"line", "bumper", "rope", "no divider"};
  return "seed " + std::to_string(scene.seed) + ": " + dividers[static_cast<std::size_t>(scene.rink.sheet.divider)] +
         ", " + std::to_string(scene.exposure.stones.size()) + " stones, " +
         std::to_string(scene.exposure.people.size()) + " people, x " + std::to_string(scene.body.x_m) + " y " +
         std::to_string(scene.body.y_m) + " yaw " + std::to_string(scene.body.yaw_rad / degree) + " deg, gamma " +
         std::to_string(scene.setup.gamma);
}

// One colour a pixel, the others interpolated, in linear light as cameras do it.
void through_mosaic(double gamma, cv::Mat& bgr) {
  constexpr double full = 65535.0;
  std::array<std::uint16_t, 256> linear{};
  for (std::size_t v = 0; v < linear.size(); ++v) {
    linear[v] = static_cast<std::uint16_t>(std::lround(full * std::pow(static_cast<double>(v) / 255.0, gamma)));
  }
  std::vector<std::uint8_t> byte(65536);
  for (std::size_t v = 0; v < byte.size(); ++v) {
    byte[v] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(static_cast<double>(v) / full, 1.0 / gamma)));
  }
  cv::Mat mosaic(bgr.size(), CV_16UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* in = bgr.ptr<cv::Vec3b>(y);
    auto* out = mosaic.ptr<std::uint16_t>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const int channel = (y % 2) == (x % 2) ? (y % 2 == 0 ? 2 : 0) : 1;
      out[x] = linear[in[x][channel]];
    }
  }
  cv::Mat mixed;
  cv::cvtColor(mosaic, mixed, cv::COLOR_BayerBG2BGR);  // OpenCV's name for RGGB
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* in = mixed.ptr<std::uint16_t>(y);
    auto* out = bgr.ptr<std::uint8_t>(y);
    for (int i = 0; i < 3 * bgr.cols; ++i) out[i] = byte[in[i]];
  }
}

}  // namespace

RandomScene random_scene(std::uint64_t seed, const SceneMix& mix) {
  Dice dice(seed);
  RandomScene scene;
  scene.seed = seed;
  place_robot(dice, mix, scene);
  dress_sheet(dice, scene);
  place_things(dice, mix, scene);
  choose_sensor(dice, mix, scene);
  scene.exposure.eMc = scene.eMc;
  scene.sheet_width_m = scene.rink.sheet.width_m;
  switch (scene.rink.sheet.divider) {
    case Divider::line:
      scene.setup.sheet.sideline = vision::SidelineKind::line;
      break;
    case Divider::bumper:
      scene.setup.sheet.sideline = vision::SidelineKind::bumper;
      break;
    case Divider::none:
      scene.setup.sheet.sideline = vision::SidelineKind::none;
      break;
    case Divider::rope:
      scene.setup.sheet.sideline = vision::SidelineKind::unknown;
      break;
  }
  scene.what = words(scene);
  return scene;
}

cv::Mat render(const RandomScene& scene, const SceneMix& mix) {
  const hw::sim::SheetRenderer renderer(scene.setup.intrinsics, scene.setup.ice, scene.rink, scene.sensor, scene.seed);
  cv::Mat bgr;
  renderer.render(scene.exposure, scene.seed, bgr);
  if (mix.colour_mosaic) through_mosaic(scene.sensor.gamma, bgr);
  if (mix.jpeg_quality > 0) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, mix.jpeg_quality});
    bgr = cv::imdecode(bytes, cv::IMREAD_COLOR);
  }
  return bgr;
}

}  // namespace hogline::testing
