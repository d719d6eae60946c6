// hogline_far_crowds [COUNT [FIRST]]: recall, ghosts, teams and errors over random crowded far scenes, with every
// failure listed: five to eight stones down the sheet, with people, neighbours' stones and logos.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <string>

#include "tests/vision/far/far_score.hpp"

namespace {

double worst(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

int main(int argc, char** argv) {
  using hogline::vision::testing::FarScore;
  cv::setNumThreads(1);
  const int count = argc > 1 ? std::atoi(argv[1]) : 30;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const bool no_stones = argc > 3 && std::string(argv[3]) == "people";
  const FarScore score = hogline::vision::testing::score_far(
      first, count, no_stones ? hogline::vision::testing::nobodys_stones() : hogline::vision::testing::crowded());
  for (const std::string& failure : score.failures) std::printf("%s\n", failure.c_str());
  std::printf("%d scenes, %d refused: %d of %d stones in sight missed, %d ghosts, %d of the wrong team, %d of none\n",
              count, score.refused, score.missed, score.in_sight, score.ghosts, score.wrong_team, score.unknown_team);
  std::printf("across %.1f mm RMS, %.1f at most, %.2f sigmas; along %.1f mm RMS, %.1f at most, %.2f sigmas\n",
              1e3 * FarScore::rms(score.across_m), 1e3 * worst(score.across_m), FarScore::rms(score.across_sigmas),
              1e3 * FarScore::rms(score.along_m), 1e3 * worst(score.along_m), FarScore::rms(score.along_sigmas));
  return 0;
}
