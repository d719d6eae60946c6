#include "vision/fit/place_choice.hpp"

#include <algorithm>
#include <cmath>

#include "vision/fit/paint.hpp"

namespace hogline::vision {
namespace {

constexpr double spacing_px = 10.0;
constexpr double even_share = 0.4;  // of the places are spread evenly
constexpr double place_sigma_px = 0.1;

}  // namespace

PlaceChoice::PlaceChoice(int wanted_places, std::size_t most_places) : wanted_(wanted_places) {
  planned_.reserve(most_places);
}

void PlaceChoice::judge_by(const ParameterMatrix& covariance, const BodyByParameters& body) {
  worth_.noalias() = body * covariance;
  for (int k = 0; k < 3; ++k) worth_.row(k) /= std::sqrt(std::max(worth_.row(k).dot(body.row(k)), 1e-18));
}

// The share of the variances of x, y and yaw that the place took away.
double PlaceChoice::tells(const PlannedSite& site) const {
  return (worth_ * site.along.transpose()).squaredNorm() /
         (place_sigma_px * place_sigma_px + site.floor_px * site.floor_px);
}

void PlaceChoice::plan(const SheetCamera& camera, const FitState& state, int feature) {
  SitePlan how;
  how.spacing_px = spacing_px;
  how.only_feature = feature;
  planned_.clear();
  plan_sites(camera, state, how, planned_);
}

// Takes places in turn, as often as they are worth.
void PlaceChoice::keep_chosen() {
  double sum = 0.5 * quantum_;
  const auto passed_over = [&](const PlannedSite& site) {
    sum += even_ + tells(site);
    if (sum < quantum_) return true;
    sum = std::min(sum - quantum_, quantum_);
    return false;
  };
  planned_.erase(std::remove_if(planned_.begin(), planned_.end(), passed_over), planned_.end());
}

void PlaceChoice::choose_all(const SheetCamera& camera, const FitState& state, std::vector<PlannedSite>& sites) {
  plan(camera, state, -1);
  double sum = 0.0;
  for (const PlannedSite& site : planned_) sum += tells(site);
  even_ = even_share / (1.0 - even_share) * sum / std::max(1.0, static_cast<double>(planned_.size()));
  quantum_ = sum / (1.0 - even_share) / wanted_;
  keep_chosen();
  sites.assign(planned_.begin(), planned_.end());
}

void PlaceChoice::renew_one_feature(const SheetCamera& camera, const FitState& state, std::vector<PlannedSite>& sites) {
  const int feature = next_feature_;
  next_feature_ = (next_feature_ + 1) % paint_feature_count;
  const auto first = std::partition_point(sites.begin(), sites.end(),
                                          [feature](const PlannedSite& site) { return site.feature < feature; });
  const auto last = std::find_if(first, sites.end(), [feature](const PlannedSite& s) { return s.feature != feature; });
  const auto place = sites.erase(first, last);
  plan(camera, state, feature);
  keep_chosen();
  sites.insert(place, planned_.begin(), planned_.end());
  const double too_many = static_cast<double>(sites.size()) / wanted_;
  quantum_ *= std::pow(std::clamp(too_many, 0.5, 2.0), 1.0 / paint_feature_count);
}

}  // namespace hogline::vision
