// Robust Gauss-Newton steps of the joint fit, over sites that were looked for.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vision/fit/fit_parameters.hpp"
#include "vision/fit/paint.hpp"
#include "vision/fit/site_measurement.hpp"
#include "vision/fit/site_planner.hpp"

namespace hogline::vision {

/// What is known of the change beforehand, as normal equations: information * change = pull.
struct Prior {
  ParameterMatrix information = ParameterMatrix::Zero();
  ParameterVector pull = ParameterVector::Zero();

  /// One more: row . change = value, within sigma.
  void add(const ParameterRow& row, double value, double sigma);
};

/// How random samples are drawn: from how wrong the start may be, by a generator with this seed.
struct Consensus {
  Eigen::Matrix<double, 6, 1> start_sigma;  ///< of the twist
  int seed = 0;
};

/// The change that brings most candidates together, each site choosing among its own: a consensus of random samples,
/// (none: from no change), then weights by Tukey whose reach shrinks to two pixels.
struct WideStep {
  ParameterVector change = ParameterVector::Zero();
  double agreeing_share = 0.0;
  int agreeing = 0;
};
WideStep step_widely(const std::vector<PlannedSite>& sites, const std::vector<Candidates>& seen, const Prior& prior,
                     const std::optional<Consensus>& consensus);

/// The robust change over subpixel places, with what is needed to judge it. Buffers keep their room.
struct CloseStep {
  ParameterVector change = ParameterVector::Zero();
  ParameterMatrix information = ParameterMatrix::Zero();  ///< normal matrix with the prior
  std::vector<double> residual_px;                        ///< after the change; only of found sites
  std::vector<double> weight;                             ///< 0 to 1
  std::vector<double> spread_px;                          ///< expected of each residual
  double scale = 1.0;                                     ///< robust spread of residual / sigma
  std::array<bool, paint_feature_count> dropped{};        ///< features that do not fit with the rest
};
/// The first weights are by the residuals at `start`.
void step_closely(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, const Prior& prior,
                  CloseStep& step, std::vector<double>& scratch,
                  const ParameterVector& start = ParameterVector::Zero());

/// Of the parameters: the scatter of what stretches of features pull, so that errors shared by neighbouring sites count
/// as they should, plus `shared_px` of error common to each feature.
ParameterMatrix covariance_of(const std::vector<PlannedSite>& sites, const CloseStep& step, const Prior& prior,
                              double shared_px);

}  // namespace hogline::vision
