// A picture that shows nothing is told from one that shows little.
#include "vision/picture/picture_check.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace hogline::vision {
namespace {

cv::Mat noisy(int type, double mean, double sigma, std::uint64_t seed, cv::Size size = {320, 240}) {
  cv::Mat picture(size, type);
  cv::RNG random(seed);
  random.fill(picture, cv::RNG::NORMAL, cv::Scalar::all(mean), cv::Scalar::all(sigma));
  return picture;
}

cv::Mat ramp(int type, double from, double to, double sigma, std::uint64_t seed) {
  cv::Mat picture = noisy(type, 0.0, sigma, seed);
  cv::Mat sum;
  cv::Mat slope(picture.size(), CV_32FC1);
  for (int x = 0; x < slope.cols; ++x) slope.col(x) = from + (to - from) * x / (slope.cols - 1);
  cv::Mat channels;
  cv::merge(std::vector<cv::Mat>(static_cast<std::size_t>(picture.channels()), slope), channels);
  cv::add(noisy(type, 0.0, 0.0, seed), channels, sum, cv::noArray(), CV_32F);
  cv::Mat noise(sum.size(), sum.type());
  cv::RNG random(seed);
  random.fill(noise, cv::RNG::NORMAL, cv::Scalar::all(0.0), cv::Scalar::all(sigma));
  sum += noise;
  sum.convertTo(picture, CV_8U);
  return picture;
}

struct Case {
  const char* description;
  cv::Mat picture;
  std::optional<PictureFault> fault;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.description; }

class Pictures : public testing::TestWithParam<Case> {};

TEST_P(Pictures, are_judged) {
  const PictureVerdict verdict = PictureCheck().check(GetParam().picture);
  EXPECT_EQ(verdict.fault, GetParam().fault) << verdict.describe();
  EXPECT_FALSE(verdict.describe().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Table, Pictures,
    testing::Values(Case{"all zero", cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)), PictureFault::black},
                    Case{"all zero, one channel", cv::Mat(240, 320, CV_8UC1, cv::Scalar(0)), PictureFault::black},
                    Case{"lens covered, sensor noise", noisy(CV_8UC3, 2.0, 2.0, 1), PictureFault::black},
                    Case{"lens covered, pedestal of 16", noisy(CV_8UC1, 16.0, 3.0, 2), PictureFault::black},
                    Case{"lens covered, response curve of 2.2", noisy(CV_8UC3, 21.0, 4.0, 3), PictureFault::black},
                    Case{"dim hall: dark, but with structure", ramp(CV_8UC3, 4.0, 24.0, 2.0, 4), std::nullopt},
                    Case{"fog: flat and grey", noisy(CV_8UC3, 120.0, 3.0, 5), std::nullopt},
                    Case{"exposure run away", noisy(CV_8UC3, 400.0, 20.0, 6), PictureFault::saturated},
                    Case{"exposure run away, one channel", cv::Mat(240, 320, CV_8UC1, cv::Scalar(255)),
                         PictureFault::saturated},
                    Case{"half of it in glare", ramp(CV_8UC1, 120.0, 400.0, 4.0, 7), std::nullopt},
                    Case{"bright ice below the sensor's end", noisy(CV_8UC3, 235.0, 3.0, 8), std::nullopt},
                    Case{"smaller than the grid of blocks", noisy(CV_8UC1, 100.0, 5.0, 9, {8, 8}), std::nullopt}));

TEST(PictureCheck, the_same_bytes_again_are_frozen_and_noise_is_not) {
  PictureCheck check;
  const cv::Mat first = noisy(CV_8UC3, 120.0, 3.0, 1);
  EXPECT_FALSE(check.check(first).fault);
  EXPECT_FALSE(check.check(noisy(CV_8UC3, 120.0, 3.0, 2)).fault);
  EXPECT_FALSE(check.check(first).fault) << "an older picture is no repetition";
  EXPECT_EQ(check.check(first.clone()).fault, PictureFault::frozen);
  check.forget();
  EXPECT_FALSE(check.check(first).fault);
}

TEST(PictureCheck, an_area_that_goes_on_living_is_not_frozen) {
  PictureCheck check;
  cv::Mat picture = noisy(CV_8UC3, 120.0, 3.0, 1);
  check.check(picture);
  picture = picture.clone();
  picture.at<cv::Vec3b>(16, 40)[1] ^= 1U;
  EXPECT_FALSE(check.check(picture).fault);
}

TEST(PictureCheck, passes_every_scene) {
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(HOGLINE_TEST_DATA)) {
    if (entry.path().extension() != ".jpg") continue;
    PictureCheck check;
    const PictureVerdict verdict = check.check(cv::imread(entry.path().string(), cv::IMREAD_COLOR));
    EXPECT_FALSE(verdict.fault) << entry.path() << " " << verdict.describe();
    ++seen;
  }
  EXPECT_GE(seen, 5);
}

}  // namespace
}  // namespace hogline::vision
