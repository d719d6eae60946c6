#include "vision/hog_line_evidence.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/vision/low/painted_ice.hpp"

namespace hogline::vision {
namespace {

using namespace testing;

constexpr double hog_m = rules::tee_to_hog_m;

HogLineEvidence evidence_of(const CameraSetup& setup, const PaintedSheet& painted, const PaintedSheet& believed) {
  const cv::Mat image = paint(setup, painted);
  const ResponseCurve response(setup.gamma);
  const Picture picture{image.data, image.cols, image.rows, image.channels(), image.step[0]};
  Mount mount = setup.mount;
  mount.pitch_rad += believed.lean_rad;
  return weigh_hog_line(picture, response, {Lens(setup.intrinsics), eMb(believed.body) * bMc(mount), setup.ice});
}

struct EvidenceCase {
  const char* description;
  void (*change)(PaintedSheet&);
  const char* doubt;  ///< a part of it; empty: none
  double up_to_m = 4.0;
};

class Evidence : public ::testing::TestWithParam<EvidenceCase> {};

TEST_P(Evidence, SpeaksForOurHogLineAlone) {
  const CameraSetup setup = low_camera();
  for (const double distance_m : {0.95, 4.0}) {
    if (distance_m > GetParam().up_to_m) continue;
    SCOPED_TRACE(distance_m);
    PaintedSheet sheet;
    sheet.body = {.x_m = 0.1, .y_m = hog_m - distance_m, .yaw_rad = 0.02};
    GetParam().change(sheet);
    const std::string why = doubt(evidence_of(setup, sheet, sheet));
    if (std::string(GetParam().doubt).empty()) {
      EXPECT_EQ(why, "");
    } else {
      EXPECT_NE(why.find(GetParam().doubt), std::string::npos) << "it says: " << why;
    }
  }
}

// How wide a line is can be told where it is some pixels wide.
INSTANTIATE_TEST_SUITE_P(
    hog_line, Evidence,
    ::testing::Values(
        EvidenceCase{"as_it_should_be", [](PaintedSheet&) {}, ""},
        EvidenceCase{"in_yellow", [](PaintedSheet& s) { s.hog_colour = yellow; }, ""},
        EvidenceCase{"half_of_it_under_a_logo",
                     [](PaintedSheet& s) {
                       s.patches.push_back({{-2.4, -0.1}, {hog_m - 0.3, hog_m + 0.4}, blue});
                     },
                     ""},
        EvidenceCase{"not_there", [](PaintedSheet& s) { s.hog_line = false; }, "not as a hog line should be"},
        EvidenceCase{"too_thin",
                     [](PaintedSheet& s) {
                       s.hog_line = false;
                       s.patches.push_back({{-2.4, 2.4}, {hog_m + 0.03, hog_m + 0.07}, black});
                     },
                     "not as a hog line should be", 2.0},
        EvidenceCase{"the_edge_of_a_band",
                     [](PaintedSheet& s) {
                       s.hog_line = false;
                       s.patches.push_back({{-2.4, 2.4}, {hog_m, hog_m + 0.5}, blue});
                     },
                     "not as a hog line should be"},
        EvidenceCase{"the_ice_between_two_logos",
                     [](PaintedSheet& s) {
                       s.hog_line = false;
                       s.patches.push_back({{-2.4, 2.4}, {hog_m - 0.5, hog_m}, blue});
                       s.patches.push_back({{-2.4, 2.4}, {hog_m + rules::hog_line_width_m, hog_m + 0.5}, blue});
                     },
                     "not as a hog line should be"},
        EvidenceCase{"half_as_long",
                     [](PaintedSheet& s) {
                       s.hog_line = false;
                       s.patches.push_back({{-0.2, 2.4}, {hog_m, hog_m + rules::hog_line_width_m}, red});
                     },
                     "ends within the sheet"},
        EvidenceCase{"of_dashes",
                     [](PaintedSheet& s) {
                       s.hog_line = false;
                       for (double x = -2.4; x < 2.4; x += 0.5) {
                         s.patches.push_back({{x, x + 0.35}, {hog_m, hog_m + rules::hog_line_width_m}, red});
                       }
                     },
                     "ends within the sheet"},
        EvidenceCase{"a_logo_over_the_centre_line_beyond",
                     [](PaintedSheet& s) {
                       s.patches.push_back({{-0.6, 0.6}, {hog_m + 0.3, hog_m + 3.0}, blue});
                     },
                     ""},
        EvidenceCase{"no_centre_line", [](PaintedSheet& s) { s.centre_line = false; }, "the centre line"}),
    [](const auto& c) { return std::string(c.param.description); });

TEST(Evidence, ToldFromTheOtherEndsByWhereTheHouseLies) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = {.x_m = -0.1, .y_m = hog_m - 2.5, .yaw_rad = -0.01};
  EXPECT_FALSE(evidence_of(setup, sheet, sheet).house_beyond);
  sheet.house_beyond = true;
  EXPECT_TRUE(evidence_of(setup, sheet, sheet).house_beyond);
}

TEST(Evidence, DoesNotSpeakForALineElsewhere) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = {.x_m = 0.0, .y_m = hog_m - 2.0, .yaw_rad = 0.0};
  for (const PlanarPose& wrong : {PlanarPose{0.0, hog_m - 2.1, 0.0}, PlanarPose{0.0, hog_m - 1.9, 0.0},
                                  PlanarPose{0.3, hog_m - 2.0, 0.0}, PlanarPose{0.0, hog_m - 2.0, 0.05}}) {
    PaintedSheet believed = sheet;
    believed.body = wrong;
    EXPECT_NE(doubt(evidence_of(setup, sheet, believed)), "") << wrong.x_m << ' ' << wrong.y_m << ' ' << wrong.yaw_rad;
  }
}

}  // namespace
}  // namespace hogline::vision
