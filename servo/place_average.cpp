#include "servo/place_average.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double sigma_of_mad = 1.4826;
constexpr double outlier_sigmas = 4.0;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Average {
  double value = 0.0;
  double sigma = 0.0;
  std::vector<bool> kept;
};

template <class Value, class Sigma>
Average robust(const std::vector<SheetPosePercept>& looks, Value value_of, Sigma sigma_of) {
  std::vector<double> values;
  std::vector<double> sigmas;
  values.reserve(looks.size());
  sigmas.reserve(looks.size());
  for (const SheetPosePercept& look : looks) {
    values.push_back(value_of(look));
    sigmas.push_back(sigma_of(look));
  }
  const double centre = median(values);
  std::vector<double> distances;
  distances.reserve(values.size());
  for (const double value : values) distances.push_back(std::abs(value - centre));
  Average average;
  average.sigma = std::max(median(sigmas), sigma_of_mad * median(distances));
  double sum = 0.0;
  int count = 0;
  for (const double value : values) {
    const bool keep = std::abs(value - centre) <= outlier_sigmas * average.sigma;
    average.kept.push_back(keep);
    sum += keep ? value : 0.0;
    count += keep ? 1 : 0;
  }
  average.value = sum / count;
  return average;
}

}  // namespace

void PlaceAverage::add(const SheetPosePercept& look) {
  if (!look.ok) return;
  for (const SheetPosePercept& taken : looks_) {
    if (taken.stamp == look.stamp) return;
  }
  looks_.push_back(look);
}

std::optional<StandingPlace> PlaceAverage::average() const {
  if (looks_.empty()) return std::nullopt;
  using Look = SheetPosePercept;
  const Average x = robust(
      looks_, [](const Look& l) { return l.body.x_m; }, [](const Look& l) { return l.sigma.x_m; });
  const Average y = robust(
      looks_, [](const Look& l) { return l.body.y_m; }, [](const Look& l) { return l.sigma.y_m; });
  const Average yaw = robust(
      looks_, [](const Look& l) { return l.body.yaw_rad; }, [](const Look& l) { return l.sigma.yaw_rad; });
  const Average hog = robust(
      looks_, [](const Look& l) { return l.hog_distance_m; }, [](const Look& l) { return l.hog_distance_sigma_m; });
  StandingPlace place;
  place.body = {x.value, y.value, yaw.value};
  place.sigma = {x.sigma, y.sigma, yaw.sigma};
  place.hog_distance_m = hog.value;
  place.hog_distance_sigma_m = hog.sigma;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const bool kept = x.kept[i] && y.kept[i] && yaw.kept[i] && hog.kept[i];
    ++(kept ? place.used : place.thrown_out);
  }
  return place;
}

}  // namespace hogline::servo
