// What single looks and sequences share. For the source files of FarView and FarSequence only.
#pragma once

#include "vision/far_view/far_levels.hpp"
#include "vision/far_view/far_scan.hpp"
#include "vision/far_view/far_sheet.hpp"
#include "vision/far_view/far_view.hpp"
#include "vision/stone_screening.hpp"

namespace hogline::vision {

/// Why a picture can not be one of this camera; empty when it can.
std::string unusable(const cv::Mat& image, const Intrinsics& intrinsics);

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

struct FarView::Impl {
  explicit Impl(const FarSetup& given);
  FarPercept look(const cv::Mat& image, Stamp stamp, const FarPlan& plan, FarSketch* sketch);
  const std::vector<StoneCandidate>& vote(int level, const std::vector<FarPlace>& places, const StoneArea& area);
  void find_stones(const std::vector<FarPlace>& places, const FarArea& area, FarPercept& seen, FarSketch* sketch);

  FarSetup setup;
  ResponseCurve response;
  FarSheet sheet;
  FarLevels levels;
  FarScan scan;
  StoneGroups groups;
  StoneVoter voter;
  std::vector<StoneCandidate> candidates;
  StoneScreening screening;
};

}  // namespace hogline::vision
