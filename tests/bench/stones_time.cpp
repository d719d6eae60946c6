// hogline_stones_time [BOARDS]: processor time of finding the stones on random boards of eight, the pose known.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "tests/bench/processor_time.hpp"
#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const int boards = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  const int passes = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  constexpr std::size_t stones = 8;
  std::vector<double> all;
  int done = 0;
  for (std::uint64_t seed = 1; done < boards; ++seed) {
    const auto board = hogline::testing::random_board(seed);
    if (board.stones.size() != stones) continue;
    const cv::Mat bgr = hogline::testing::render(board.scene);
    hogline::vision::StonesSetup setup;
    setup.camera = board.scene.setup;
    hogline::vision::StoneFinder finder(setup);
    std::vector<double> ms;
    std::size_t found = 0;
    for (int pass = 0; pass < passes; ++pass) {
      const double begin = hogline::bench::processor_time_s();
      found = finder.find(bgr, {}, board.scene.eMc, board.scene.sheet_width_m).stones.size();
      ms.push_back(1e3 * (hogline::bench::processor_time_s() - begin));
    }
    const double best = *std::min_element(ms.begin(), ms.end());
    std::printf("board %llu: %zu of %zu found, %.2f ms\n", static_cast<unsigned long long>(seed), found, stones, best);
    all.push_back(best);
    ++done;
  }
  std::sort(all.begin(), all.end());
  std::printf("%d boards of %zu stones: median %.2f ms, most %.2f ms\n", done, stones, all[all.size() / 2], all.back());
  return 0;
}
