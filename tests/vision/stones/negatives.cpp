#include "tests/vision/stones/negatives.hpp"

namespace hogline::vision::testing {
namespace {

using hogline::testing::random_board;
using hogline::testing::RandomBoard;

constexpr hw::sim::Colour granite_paint{0.2F, 0.2F, 0.21F};
constexpr hw::sim::Colour red_paint{0.55F, 0.02F, 0.02F};

RandomBoard bare(std::uint64_t seed) { return random_board(seed, {.most_stones = 0, .most_people = 0}); }

/// Where a point over the ice seems to lie on it.
double on_ice_y(const RandomBoard& board, double y_m, double z_m) {
  const Eigen::Vector3d eye = board.scene.eMc.translation();
  return eye.y() + (y_m - eye.y()) * eye.z() / (eye.z() - z_m);
}

void paint(RandomBoard& board, double x_m, double width_m, double from_y_m, double to_y_m,
           const hw::sim::Colour& colour) {
  board.scene.rink.sheet.logos.push_back({x_m, 0.5 * (from_y_m + to_y_m), width_m, to_y_m - from_y_m, colour});
}

}  // namespace

RandomBoard people_in_grey(std::uint64_t seed) {
  RandomBoard board = bare(seed);
  for (const double x_m : {-1.0, 0.2, 1.1}) {
    hw::sim::PersonLook person;
    person.x_m = x_m;
    person.y_m = 0.8 + x_m;
    person.trousers = {0.2F, 0.2F, 0.2F};
    person.jacket = red_paint;
    board.scene.exposure.people.push_back(person);
  }
  return board;
}

RandomBoard painted_stones(std::uint64_t seed) {
  RandomBoard board = bare(seed);
  int k = 0;
  for (const double x_m : {-1.2, -0.4, 0.5, 1.3}) {
    const double y_m = 0.2 + 0.8 * k++ + 0.1 * static_cast<double>(seed % 7);
    const double foot_m = y_m - 0.11;
    const double edge_m = on_ice_y(board, y_m - 0.095, 0.11);
    const double rim_m = on_ice_y(board, y_m + 0.095, 0.125);
    paint(board, x_m, 0.30, foot_m, 0.5 * (edge_m + rim_m), granite_paint);
    paint(board, x_m, 0.20, edge_m, rim_m, red_paint);
  }
  return board;
}

RandomBoard handle_coloured_logos(std::uint64_t seed) {
  RandomBoard board = bare(seed);
  for (const double x_m : {-1.2, -0.4, 0.5, 1.3}) {
    board.scene.rink.sheet.logos.push_back({x_m, 2.8, 0.19, 0.19, red_paint});
    board.scene.rink.sheet.logos.push_back({x_m, 0.4, 0.25, 0.2, {0.75F, 0.55F, 0.03F}});
  }
  return board;
}

// A broom's head lies flat: a pad of the handles' colour on a grey plate, and the shaft.
RandomBoard brooms(std::uint64_t seed) {
  RandomBoard board = bare(seed);
  for (const double x_m : {-1.3, -0.5, 0.4, 1.2}) {
    const double y_m = 1.0 + x_m;
    board.scene.rink.sheet.logos.push_back({x_m, y_m, 0.22, 0.08, granite_paint});
    board.scene.rink.sheet.logos.push_back({x_m, y_m + 0.06, 0.20, 0.05, red_paint});
    board.scene.rink.sheet.logos.push_back({x_m, y_m - 0.6, 0.03, 1.1, {0.72F, 0.52F, 0.03F}});
  }
  return board;
}

}  // namespace hogline::vision::testing
