// hogline_stones_time [BOARDS [PASSES]]: processor time of finding the stones on random boards of eight, the pose
// known, with the share of each stage. Of each board the shortest pass counts.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "tests/bench/processor_time.hpp"
#include "tests/support/random_board.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_vote.hpp"
#include "vision/stones.hpp"

namespace {

using namespace hogline::vision;

enum Stage { ice_light, boxes, votes, screening, joint_fit, all, stages };
constexpr std::array<const char*, stages> names{"white ice's light", "boxes", "votes", "screening", "joint fit", "all"};
using Times = std::array<double, stages>;

template <typename Work>
double elapsed_ms(const Work& work) {
  const double begin = hogline::bench::processor_time_s();
  work();
  return 1e3 * (hogline::bench::processor_time_s() - begin);
}

/// One look by the finder, and its stages by themselves; screening is what is left.
class Stopwatch {
 public:
  explicit Stopwatch(const hogline::testing::RandomBoard& board)
      : board_(board),
        bgr_(hogline::testing::render(board.scene)),
        lens_(board.scene.setup.intrinsics),
        response_(board.scene.setup.gamma),
        camera_(lens_, board.scene.eMc, board.scene.setup.ice),
        groups_(board.scene.setup, shape_) {
    StonesSetup setup;
    setup.camera = board.scene.setup;
    finder_.emplace(setup);
  }

  Times pass() {
    Times ms{};
    hogline::StonesPercept seen;
    ms[all] = elapsed_ms([&] { seen = finder_->find(bgr_, {}, board_.scene.eMc, board_.scene.sheet_width_m); });
    std::optional<WhiteLight> ice;
    ms[ice_light] = elapsed_ms([&] { ice.emplace(bgr_, response_, groups_.top()); });
    const StonePicture picture{bgr_, response_, *ice, camera_, shape_};
    ms[boxes] = elapsed_ms([&] { found_ = groups_.find(bgr_, *ice, response_); });
    ms[votes] = elapsed_ms([&] { voter_.find(picture, found_); });
    std::vector<StoneStart> places;
    for (const auto& s : seen.stones) places.push_back({{s.x_m, s.y_m}});
    ms[joint_fit] = elapsed_ms([&] {
      fitter_.begin(picture, places, {});
      fitter_.run();
    });
    ms[screening] = ms[all] - ms[ice_light] - ms[boxes] - ms[votes] - ms[joint_fit];
    stones = seen.stones.size();
    return ms;
  }

  std::size_t stones = 0;

 private:
  const hogline::testing::RandomBoard& board_;
  cv::Mat bgr_;
  Lens lens_;
  ResponseCurve response_;
  SheetCamera camera_;
  StoneShape shape_;
  StoneGroupFinder groups_;
  StoneGroups found_;
  StoneVoter voter_;
  StoneFitter fitter_;
  std::optional<StoneFinder> finder_;
};

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const int boards = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
  const int passes = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  std::array<std::vector<double>, stages> times;
  for (std::uint64_t seed = 1; static_cast<int>(times[all].size()) < boards; ++seed) {
    const auto board = hogline::testing::random_board(seed);
    if (board.stones.size() != 8) continue;
    Stopwatch watch(board);
    Times best = watch.pass();
    for (int pass = 1; pass < passes; ++pass) {
      const Times ms = watch.pass();
      for (std::size_t i = 0; i < stages; ++i) best[i] = std::min(best[i], ms[i]);
    }
    std::fprintf(stderr, "board %llu: %zu of 8 found, %.2f ms\n", static_cast<unsigned long long>(seed), watch.stones,
                 best[all]);
    for (std::size_t i = 0; i < stages; ++i) times[i].push_back(best[i]);
  }
  std::printf("| stage | median ms |\n|---|--:|\n");
  for (std::size_t i = 0; i < stages; ++i) std::printf("| %s | %.2f |\n", names[i], median(times[i]));
  std::printf("| the slowest board | %.2f |\n", *std::max_element(times[all].begin(), times[all].end()));
  return 0;
}
