// hogline_handles [COUNT [FIRST]]: the handles' directions on random boards against the truth, by distance.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <opencv2/core/utility.hpp>

#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

namespace {

constexpr std::array<double, 6> upto_m{3.0, 4.5, 6.0, 7.5, 9.0, 12.0};
constexpr double degree = std::numbers::pi / 180.0;

struct Row {
  int stones = 0;
  int measured = 0;
  int wild = 0;  // more than four sigmas off
  double sum = 0.0;
  double squares = 0.0;
  double in_sigmas = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  using namespace hogline::vision;
  cv::setNumThreads(1);
  const int count = argc > 1 ? std::atoi(argv[1]) : 100;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  std::array<Row, upto_m.size()> rows;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    const auto board = hogline::testing::random_board(seed);
    StonesSetup setup;
    setup.camera = board.scene.setup;
    StoneFinder finder(setup);
    const auto seen =
        finder.find(hogline::testing::render(board.scene), {}, board.scene.eMc, board.scene.sheet_width_m);
    const Eigen::Vector3d eye = board.scene.eMc.translation();
    for (const auto& s : seen.stones) {
      for (const auto& truth : board.scene.exposure.stones) {
        if (std::hypot(s.x_m - truth.x_m, s.y_m - truth.y_m) > 0.1) continue;
        const double range_m = std::hypot(s.x_m - eye.x(), s.y_m - eye.y());
        std::size_t i = 0;
        while (i + 1 < rows.size() && range_m > upto_m[i]) ++i;
        ++rows[i].stones;
        if (!s.handle_rad) continue;
        const double error = std::remainder(*s.handle_rad - truth.handle_rad, std::numbers::pi);
        ++rows[i].measured;
        rows[i].sum += error;
        rows[i].squares += error * error;
        rows[i].in_sigmas += std::pow(error / s.handle_sigma_rad, 2);
        const bool wild = std::abs(error) > 4.0 * s.handle_sigma_rad;
        rows[i].wild += wild ? 1 : 0;
        if (wild) {
          std::printf("board %llu: (%.2f, %.2f): %.1f deg off, sigma %.1f\n", static_cast<unsigned long long>(seed),
                      s.x_m, s.y_m, error / degree, s.handle_sigma_rad / degree);
        }
      }
    }
  }
  std::printf("| stones up to m away | seen | measured | bias deg | RMS deg | RMS in sigmas | beyond four |\n");
  std::printf("|--:|--:|--:|--:|--:|--:|--:|\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    if (r.measured == 0) continue;
    std::printf("| %.1f | %d | %d | %.1f | %.1f | %.2f | %d |\n", upto_m[i], r.stones, r.measured,
                r.sum / r.measured / degree, std::sqrt(r.squares / r.measured) / degree,
                std::sqrt(r.in_sigmas / r.measured), r.wild);
  }
  return 0;
}
