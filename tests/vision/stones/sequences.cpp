// hogline_stone_sequences [COUNT [FIRST [RATE_HZ [PICTURES [STRUCK_AT]]]]]: boards in which a stone is struck and
// somebody walks, followed by the sequence, and the same pictures looked at one by one by the finder.
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>

#include "tests/vision/stones/moving_board.hpp"

int main(int argc, char** argv) {
  using namespace hogline::vision;
  cv::setNumThreads(1);
  const int count = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 5001);
  const double rate_hz = argc > 3 ? std::atof(argv[3]) : 30.0;
  const int pictures = argc > 4 ? std::atoi(argv[4]) : 16;
  const int struck_at = argc > 5 ? std::atoi(argv[5]) : 6;
  testing::SequenceScore followed, found;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    const testing::MovingBoard board(seed, {.rate_hz = rate_hz, .struck_at = struck_at});
    StoneSequence sequence(board.setup());
    StoneFinder finder(board.setup());
    const auto& scene = board.board().scene;
    for (int k = 0; k < pictures; ++k) {
      const cv::Mat picture = board.picture(k);
      const auto truth = board.at(k, true);
      followed.add(seed, k, truth, board.struck(),
                   sequence.look(picture, board.stamp(k), scene.eMc, scene.sheet_width_m, {}));
      found.add(seed, k, truth, board.struck(), finder.find(picture, board.stamp(k), scene.eMc, scene.sheet_width_m));
    }
  }
  for (const std::string& f : followed.failures) std::printf("followed: %s\n", f.c_str());
  for (const std::string& f : found.failures) std::printf("found: %s\n", f.c_str());
  std::printf("followed: %s\nfound:    %s\n", followed.words().c_str(), found.words().c_str());
  return 0;
}
