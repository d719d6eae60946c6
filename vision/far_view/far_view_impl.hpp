// What single looks and sequences share. For the source files of FarView and FarSequence only.
#pragma once

#include "vision/crowd_screening.hpp"
#include "vision/far_view/far_levels.hpp"
#include "vision/far_view/far_scan.hpp"
#include "vision/far_view/far_sheet.hpp"
#include "vision/far_view/far_view.hpp"
#include "vision/stone_screening.hpp"

namespace hogline::vision {

/// Why nothing can be said of a picture with this plan before it is looked at; empty when something can.
std::string unusable(const cv::Mat& image, const Intrinsics& intrinsics, const FarPlan& plan);

/// Where stones of this sheet can lie, as far as its sidelines are known.
class FarArea {
 public:
  FarArea(const FarAim& aim, std::optional<double> planned_width_m, double nominal_width_m);

  const StoneArea& whole() const { return whole_; }
  /// Its centre lies on this sheet, or not far beyond the sideline.
  bool contains(const Eigen::Vector2d& place) const;

 private:
  StoneArea whole_;
  double left_m_, right_m_;
};

/// How far a fit may end from the place of its votes: two and a half rows of pixels, or what a near stone may.
double drift_m(const Eigen::Vector2d& place, const SheetCamera& camera);

/// What the sheet's lines told.
void report_aim(const FarAim& aim, FarPercept& seen);

/// Where in the picture something is to be asked whether it is a stone.
struct FarSearch {
  std::vector<FarPlace> places;     ///< by votes, in pixels of the middle level
  std::vector<JudgedStone> stones;  ///< where they must be, but for a fit
  bool behind = false;              ///< handles that show behind these are looked for, too
};

/// The farthest row in which a stone of the area can be seen, with its grip.
int first_row(const FarArea& area, const SheetCamera& camera);

/// What single looks and sequences do alike.
struct FarView::Impl {
  Impl(const FarSetup& given, const ScreeningOptions& options);
  FarPercept look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch);

  FarArea area_of(const FarAim& aim, const FarPlan& plan) const;
  void begin(const cv::Mat& image, const Pose& eMc, const FarArea& area);
  /// Of a picture that only what is asked for is looked at.
  void go_on(const cv::Mat& image, const Pose& eMc);
  const std::vector<FarPlace>& scan_part(const FarArea& area, const FarScan::Part& part);
  /// Where a stone is seen, and what is looked at about it, on a level.
  FarPlace place_of(const Eigen::Vector2d& place) const;
  void fill(int level, const FarPlace& place);
  const std::vector<StoneCandidate>& vote(int level, const std::vector<FarPlace>& places, const FarArea& area);
  /// All that were asked, whether stones or not.
  std::vector<JudgedStone> find_stones(const FarSearch& search, const FarArea& area);
  void report(const std::vector<JudgedStone>& stones, FarPercept& seen) const;

  FarSetup setup;
  ResponseCurve response;
  FarSheet sheet;
  FarLevels levels;
  FarScan scan;
  cv::Mat centres;  ///< where handles' centres may be, half a level's size
  StoneVoter voter;
  std::vector<StoneCandidate> candidates;
  StoneScreening screening;
  CrowdScreening crowd;
};

/// Farther away a grip is a few pixels high, and seen nearly from the side.
inline constexpr double handle_range_m = 26.0;

/// For single looks, and for stones that were seen a moment ago.
ScreeningOptions careful_screening();
ScreeningOptions quick_screening();

}  // namespace hogline::vision
