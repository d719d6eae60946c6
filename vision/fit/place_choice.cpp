#include "vision/fit/place_choice.hpp"

#include <algorithm>
#include <cmath>

#include "vision/fit/paint.hpp"

namespace hogline::vision {
namespace {

constexpr double spacing_px = 10.0;
constexpr double even_share = 0.4;  // of the places are spread evenly
constexpr double place_sigma_px = 0.1;
constexpr double nearby_px = 45.0;
constexpr double hidden_worth = 0.15;  // what hides it may go away

}  // namespace

PlaceChoice::PlaceChoice(int wanted_places, std::size_t most_places, const ChoiceWishes& wishes)
    : wanted_(wanted_places), wishes_(wishes) {
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

// Round about, the feature was looked for and not seen.
bool PlaceChoice::hidden(const PlannedSite& site, const std::vector<PlannedSite>& before) const {
  if (!wishes_.avoid_hidden) return false;
  int seen = 0;
  int unseen = 0;
  for (const PlannedSite& other : before) {
    if (other.feature != site.feature || (other.pixel - site.pixel).squaredNorm() > nearby_px * nearby_px) continue;
    seen += other.borne_out > 0 ? 1 : 0;
    unseen += other.borne_out < 0 ? 1 : 0;
  }
  return unseen > 2 * seen;
}

// By how much the certain feature's places must count more, so that as many as wished are taken.
double PlaceChoice::certainty(const std::vector<PlannedSite>& before) const {
  double sum = 0.0;
  for (const PlannedSite& site : planned_) {
    if (site.feature == wishes_.certain_feature && !hidden(site, before)) sum += even_ + tells(site);
  }
  return sum > 0.0 ? std::max(1.0, wishes_.certain_places * quantum_ / sum) : 1.0;
}

// Takes places in turn, as often as they are worth.
void PlaceChoice::keep_chosen(const std::vector<PlannedSite>& before) {
  const double certain = certainty(before);
  double sum = 0.5 * quantum_;
  const auto passed_over = [&](const PlannedSite& site) {
    double worth = even_ + tells(site);
    if (site.feature == wishes_.certain_feature) worth *= certain;
    if (hidden(site, before)) worth *= hidden_worth;
    sum += worth;
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
  keep_chosen(sites);
  sites.assign(planned_.begin(), planned_.end());
}

void PlaceChoice::renew_one_feature(const SheetCamera& camera, const FitState& state, std::vector<PlannedSite>& sites) {
  const int feature = next_feature_;
  next_feature_ = (next_feature_ + 1) % paint_feature_count;
  const auto first = std::partition_point(sites.begin(), sites.end(),
                                          [feature](const PlannedSite& site) { return site.feature < feature; });
  const auto last = std::find_if(first, sites.end(), [feature](const PlannedSite& s) { return s.feature != feature; });
  plan(camera, state, feature);
  keep_chosen(sites);
  const auto place = sites.erase(first, last);
  sites.insert(place, planned_.begin(), planned_.end());
  const double too_many = static_cast<double>(sites.size()) / wanted_;
  quantum_ *= std::pow(std::clamp(too_many, 0.5, 2.0), 1.0 / paint_feature_count);
}

}  // namespace hogline::vision
