// The joint fit behind SheetFit: its state and its steps. For the source files of SheetFit and SheetTrack only.
#pragma once

#include <cmath>
#include "vision/fit/joint_solver.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/fit/sideline_scan.hpp"

namespace hogline::vision {

/// A square piece of the picture: how much paint was looked for in it, and how much fits.
struct SeenPiece {
  int tried = 0;
  int used = 0;
};

struct SheetFit::Impl {
  explicit Impl(const CameraSetup& given)
      : setup(given), lens(given.intrinsics), response(given.gamma), bRc(bMc(given.mount).linear()) {
    sites.reserve(2000);
    found.reserve(2000);
    wide.reserve(1000);
    scratch.reserve(2000);
    step.residual_px.reserve(2000);
    step.weight.reserve(2000);
    step.spread_px.reserve(2000);
    hidden.reserve(2000);
    result.sites.reserve(2000);
    result.features.reserve(paint_feature_count);
  }

  const SheetFitResult& fit(const cv::Mat& image, const SheetFitStart& start);

  std::string unusable(const cv::Mat& image, const SheetFitStart& start) const;
  SheetCamera camera() const { return {lens, state.eMc, Ice{state.paint_depth_m, setup.ice.refractive_index}}; }
  void clear_result();
  void begin(const SheetFitStart& start);
  double pitch() const;
  double pitch_sigma() const;
  Prior prior(const SheetFitStart& start) const;
  void plan(const SheetFitStart& start, double spacing_px);
  bool arrive(const PictureLight& light, const SheetFitStart& start);
  double borne_out() const;
  bool sideline_borne_out(int side) const;
  bool approach(const PictureLight& light, const SheetFitStart& start, int attempt);
  bool come_closer(const PictureLight& light, const SheetFitStart& start, double search_px,
                   const std::optional<Consensus>& consensus);
  void look(const PictureLight& light, double search_px, int half_breadth);
  void drop_odd_colours();
  bool move_by(const ParameterVector& change);
  void find_sidelines(const PictureLight& light, const SheetFitStart& start);
  void refine(const PictureLight& light, const SheetFitStart& start, double spacing_px, double search_px,
              int half_breadth);
  Eigen::Matrix<double, 3, 6> body_by_twist() const;
  void judge(const SheetFitStart& start);
  void report_width();
  void report_bleed();
  void find_hidden();
  void report_sites();
  std::string refusal(const SheetFitStart& start) const;
  const SheetFitResult& refuse(std::string reason);

  CameraSetup setup;
  Lens lens;
  ResponseCurve response;
  Eigen::Matrix3d bRc;  // b from c, as mounted

  FitState state;
  ParameterMatrix covariance = ParameterMatrix::Zero();
  std::vector<PlannedSite> sites;
  std::vector<Candidates> wide;
  std::vector<SiteMeasurement> found;
  std::vector<double> scratch;
  std::vector<SeenPiece> pieces;
  std::vector<bool> hidden;  // of the sites
  CloseStep step;
  Profile profile;
  SheetFitResult result;
};

}  // namespace hogline::vision
