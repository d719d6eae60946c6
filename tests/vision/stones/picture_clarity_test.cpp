// A blurred or noisy picture keeps the sheet's lines and loses the stones: it must not pass for an empty sheet.
#include "vision/picture_clarity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

namespace hogline::vision {
namespace {

constexpr std::uint64_t boards_from = 27001;

struct Seen {
  explicit Seen(std::uint64_t seed)
      : board(testing::random_board(seed)), bgr(testing::render(board.scene)), lens(board.scene.setup.intrinsics) {
    setup.camera = board.scene.setup;
  }

  PictureClarity clarity(const cv::Mat& picture) const {
    const ResponseCurve response(setup.camera.gamma);
    return clarity_of(picture, response, WhiteLight(picture, response, picture.rows / 3),
                      SheetCamera(lens, board.scene.eMc, setup.camera.ice));
  }
  StonesPercept find(const cv::Mat& picture) const {
    return StoneFinder(setup).find(picture, {}, board.scene.eMc, board.scene.sheet_width_m);
  }

  testing::RandomBoard board;
  cv::Mat bgr;
  Lens lens;
  StonesSetup setup;
};

cv::Mat blurred(const cv::Mat& picture, double sigma_px) {
  cv::Mat out;
  cv::GaussianBlur(picture, out, {}, sigma_px);
  return out;
}

cv::Mat smeared(const cv::Mat& picture, double length_px) {
  cv::Mat out;
  cv::filter2D(picture, out, -1, cv::Mat(1, static_cast<int>(length_px), CV_32F, 1.0 / length_px));
  return out;
}

cv::Mat noisy(const cv::Mat& picture, double sigma_levels) {
  cv::RNG random(1);
  cv::Mat noise(picture.size(), CV_16SC3);
  random.fill(noise, cv::RNG::NORMAL, 0.0, sigma_levels);
  cv::Mat sum;
  picture.convertTo(sum, CV_16SC3);
  sum += noise;
  sum.convertTo(sum, CV_8UC3);
  return sum;
}

TEST(PictureClarity, MeasuresTheBlurThatIsAdded) {
  for (std::uint64_t seed = boards_from; seed < boards_from + 6; ++seed) {
    const Seen seen(seed);
    const auto own = seen.clarity(seen.bgr).blur_px;
    ASSERT_TRUE(own) << "board " << seed;
    for (const double added_px : {0.8, 1.5, 2.5}) {
      const auto all = seen.clarity(blurred(seen.bgr, added_px)).blur_px;
      ASSERT_TRUE(all) << "board " << seed;
      EXPECT_NEAR(*all, std::hypot(*own, added_px), 0.15 * *all) << "board " << seed << ", " << added_px << " px added";
    }
  }
}

TEST(PictureClarity, MeasuresNoiseWhateverIsInTheWay) {
  for (std::uint64_t seed = boards_from; seed < boards_from + 6; ++seed) {
    const Seen seen(seed);
    const auto some = seen.clarity(noisy(seen.bgr, 4.0)).noise;
    const auto twice = seen.clarity(noisy(seen.bgr, 8.0)).noise;
    ASSERT_TRUE(some && twice) << "board " << seed;
    EXPECT_NEAR(*twice / *some, 2.0, 0.25) << "board " << seed;
  }
}

TEST(PictureClarity, ClearPicturesAreNeverRefused) {
  for (std::uint64_t seed = boards_from; seed < boards_from + 30; ++seed) {
    const Seen seen(seed);
    const PictureClarity clarity = seen.clarity(seen.bgr);
    EXPECT_EQ(clarity.fault(), "") << "board " << seed;
    EXPECT_LT(clarity.blur_px.value_or(0.0), 1.3) << "board " << seed;
    EXPECT_LT(clarity.noise.value_or(0.0), 0.015) << "board " << seed;
  }
}

TEST(PictureClarity, AnUnclearPictureIsNoEmptySheet) {
  struct Case {
    const char* description;
    cv::Mat (*spoil)(const cv::Mat&, double);
    double amount;
    const char* word;
  };
  for (const Case& c : {Case{"a lens out of focus", blurred, 3.0, "blurred"},
                        {"a misted lens", blurred, 6.0, "blurred"},
                        {"a camera that turned", smeared, 9.0, "blurred"},
                        {"a camera that turned fast", smeared, 15.0, "blurred"},
                        {"one that turned faster", smeared, 25.0, "blurred"},
                        {"gain run away", noisy, 20.0, "noisy"}}) {
    const Seen seen(boards_from);
    const StonesPercept percept = seen.find(c.spoil(seen.bgr, c.amount));
    EXPECT_FALSE(percept.ok) << c.description;
    EXPECT_NE(percept.reason.find(c.word), std::string::npos) << c.description << ": " << percept.reason;
    EXPECT_TRUE(percept.stones.empty()) << c.description;
  }
}

TEST(PictureClarity, WithoutAHouseInViewNothingIsClaimed) {
  const Seen seen(boards_from);
  const Pose away = Pose(Eigen::Translation3d(0.0, 15.0, 0.0)) * seen.board.scene.eMc;
  const ResponseCurve response(seen.setup.camera.gamma);
  const PictureClarity clarity = clarity_of(seen.bgr, response, WhiteLight(seen.bgr, response, seen.bgr.rows / 3),
                                            SheetCamera(seen.lens, away, seen.setup.camera.ice));
  EXPECT_FALSE(clarity.blur_px);
  EXPECT_EQ(clarity.fault(), "");
}

}  // namespace
}  // namespace hogline::vision
