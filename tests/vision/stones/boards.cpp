// hogline_boards [COUNT [FIRST]]: recall, precision and errors over random boards, with every failure listed.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>

#include "tests/vision/stones/board_score.hpp"

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const int count = argc > 1 ? std::atoi(argv[1]) : 100;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const auto score = hogline::vision::testing::score_boards(first, count);
  for (const std::string& failure : score.failures) std::printf("%s\n", failure.c_str());
  const double worst = score.errors_m.empty() ? 0.0 : *std::max_element(score.errors_m.begin(), score.errors_m.end());
  std::printf(
      "%d boards, %d stones in sight: recall %.2f %%, precision %.2f %%, %d of the wrong team, %d of none; errors %.1f "
      "mm RMS, %.1f mm within 2 m of the tee, %.1f mm at most\n",
      score.boards, score.stones, 100.0 * score.recall(), 100.0 * score.precision(), score.wrong_team,
      score.unknown_team, 1e3 * score.rms(score.errors_m), 1e3 * score.rms(score.house_errors_m), 1e3 * worst);
  std::vector<double> sorted = score.in_sigmas;
  std::sort(sorted.begin(), sorted.end());
  if (!sorted.empty()) {
    std::printf("errors in sigmas: %.2f RMS, %.2f median, %.2f in the worst of a hundred\n", score.rms(sorted),
                sorted[sorted.size() / 2], sorted[sorted.size() * 99 / 100]);
  }
  std::printf("beside them %d stones of which less can be seen, %d of them found; %d hidden\n", score.between,
              score.between_found, score.hidden);
  return 0;
}
