#include "vision/fit_percept.hpp"

namespace hogline::vision {

void fill_percept(const SheetFitResult& result, SheetPosePercept& percept) {
  percept.ok = result.ok;
  percept.reason = result.reason;
  percept.body = result.body;
  percept.sigma = result.sigma;
  percept.hog_distance_m = rules::tee_to_hog_m - result.body.y_m;
  percept.hog_distance_sigma_m = result.hog_distance_sigma_m;
  percept.sheet_width_m = result.sheet_width_m;
  percept.eMc = row_major(result.eMc);
  percept.residual_px = result.residual_px;
  percept.sites_used = result.sites_used;
  percept.sites_tried = result.sites_tried;
  for (const FittedFeature& f : result.features) {
    if (f.sites_used > 0) percept.features.push_back(f.name);
  }
}

}  // namespace hogline::vision
