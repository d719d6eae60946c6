#include "vision/fit/joint_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hogline::vision {
namespace {

double tukey(double residual, double reach) {
  const double q = residual / reach;
  if (std::abs(q) >= 1.0) return 0.0;
  const double k = 1.0 - q * q;
  return k * k;
}

void add_square(const ParameterRow& row, double weight, ParameterMatrix& sum) {
  const ParameterRow weighted = weight * row;
  for (int k = 0; k < parameter::count; ++k) {
    if (weighted[k] != 0.0) sum.col(k) += weighted[k] * row.transpose();  // most sites know nothing of sidelines
  }
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spread_of(const PlannedSite& site, const SiteMeasurement& m) {
  return std::sqrt(m.sigma_px * m.sigma_px + site.floor_px * site.floor_px);
}

bool counts(const PlannedSite& site, const SiteMeasurement& m, const CloseStep& step) {
  return m.found && !step.dropped[static_cast<std::size_t>(site.feature)];
}

void reweigh(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, CloseStep& step,
             std::vector<double>& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    step.residual_px[i] = found[i].found ? found[i].offset_px - sites[i].along.dot(step.change) : 0.0;
    if (counts(sites[i], found[i], step)) scratch.push_back(std::abs(step.residual_px[i]) / step.spread_px[i]);
  }
  step.scale = std::max(1.0, 1.4826 * median(scratch));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    step.weight[i] =
        counts(sites[i], found[i], step) ? tukey(step.residual_px[i], 4.685 * step.scale * step.spread_px[i]) : 0.0;
  }
}

void solve(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, const Prior& prior,
           CloseStep& step) {
  step.information = prior.information;
  ParameterVector pull = prior.pull;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (step.weight[i] <= 0.0) continue;
    const double spread = step.scale * step.spread_px[i];
    const double w = step.weight[i] / (spread * spread);
    add_square(sites[i].along, w, step.information);
    pull += w * found[i].offset_px * sites[i].along.transpose();
  }
  step.change = step.information.ldlt().solve(pull);
}

void iterate(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, const Prior& prior,
             CloseStep& step, std::vector<double>& scratch) {
  constexpr int rounds = 8;
  for (int k = 0; k < rounds; ++k) {
    reweigh(sites, found, step, scratch);
    const ParameterVector before = step.change;
    solve(sites, found, prior, step);
    if ((step.change - before).cwiseAbs().maxCoeff() < 1e-7) break;
  }
  reweigh(sites, found, step, scratch);
}

struct Choice {
  double weight = 0.0;
  double offset_px = 0.0;
};

// The candidate that suits the model best; a weak one beside a strong one counts less.
Choice choose(const Candidates& seen, double model_px, double reach_px) {
  Choice best;
  for (const Candidate& c : seen.list()) {
    const double w = tukey(c.offset_px - model_px, reach_px) * c.strength / seen.at[0].strength;
    if (w > best.weight) best = {w, c.offset_px};
  }
  return best;
}

// A small generator with a fixed seed: the same picture gives the same answer.
class Dice {
 public:
  explicit Dice(int seed) : state_(20240229U + static_cast<std::uint64_t>(seed) * 7919U) {}

  std::size_t below(std::size_t n) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state_ >> 33U) % n);
  }

 private:
  std::uint64_t state_;
};

// Random sample consensus: the change by a few sites and the start's own sigma on which most sites agree.
ParameterVector best_guess(const std::vector<PlannedSite>& sites, const std::vector<Candidates>& seen,
                           const Consensus& consensus) {
  constexpr int guesses = 300;
  constexpr int sites_a_guess = 4;
  constexpr double site_sigma_px = 1.5;
  constexpr double reach_px = 6.0;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Dice dice(consensus.seed);
  Vector6 best = Vector6::Zero();
  double best_score = -1.0;
  const Matrix6 information = consensus.start_sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  for (int g = 0; g < guesses && !sites.empty(); ++g) {
    Matrix6 normal = information;
    Vector6 pull = Vector6::Zero();
    for (int k = 0; g > 0 && k < sites_a_guess; ++k) {
      const std::size_t i = dice.below(sites.size());
      if (seen[i].count == 0) continue;
      const auto& pick = seen[i].at[dice.below(static_cast<std::size_t>(std::min(seen[i].count, 2)))];
      const Vector6 row = sites[i].along.head<6>().transpose() / site_sigma_px;
      normal.noalias() += row * row.transpose();
      pull += pick.offset_px / site_sigma_px * row;
    }
    const Vector6 change = normal.llt().solve(pull);
    double score = 0.0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (seen[i].count > 0) score += choose(seen[i], sites[i].along.head<6>().dot(change), reach_px).weight;
    }
    if (score > best_score) {
      best_score = score;
      best = change;
    }
  }
  ParameterVector change = ParameterVector::Zero();
  change.head<6>() = best;
  return change;
}

// A feature of which most was found elsewhere than the others say is something else.
bool drop_strangers(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, CloseStep& step) {
  std::array<int, paint_feature_count> seen{};
  std::array<double, paint_feature_count> agreed{};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!found[i].found) continue;
    ++seen[static_cast<std::size_t>(sites[i].feature)];
    agreed[static_cast<std::size_t>(sites[i].feature)] += step.weight[i];
  }
  bool dropped = false;
  for (std::size_t f = 0; f < paint_feature_count; ++f) {
    if (step.dropped[f] || seen[f] == 0) continue;
    if (seen[f] >= 3 && agreed[f] > 0.3 * seen[f]) continue;
    step.dropped[f] = true;
    dropped = true;
  }
  return dropped;
}

}  // namespace

void Prior::add(const ParameterRow& row, double value, double sigma) {
  const double w = 1.0 / (sigma * sigma);
  information += w * row.transpose() * row;
  pull += w * value * row.transpose();
}

WideStep step_widely(const std::vector<PlannedSite>& sites, const std::vector<Candidates>& seen, const Prior& prior,
                     const std::optional<Consensus>& consensus) {
  WideStep step;
  if (consensus) step.change = best_guess(sites, seen, *consensus);
  constexpr int rounds = 6;
  double reach_px = 8.0;
  for (int k = 0; k < rounds; ++k) {
    ParameterMatrix information = prior.information;
    ParameterVector pull = prior.pull;
    int looked = 0;
    step.agreeing = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (seen[i].count == 0) continue;
      ++looked;
      const Choice choice = choose(seen[i], sites[i].along.dot(step.change), reach_px);
      if (choice.weight <= 0.0) continue;
      ++step.agreeing;
      add_square(sites[i].along, choice.weight, information);
      pull += choice.weight * choice.offset_px * sites[i].along.transpose();
    }
    step.change = information.ldlt().solve(pull);
    step.agreeing_share = looked > 0 ? static_cast<double>(step.agreeing) / looked : 0.0;
    reach_px = std::max(2.0, 0.75 * reach_px);
  }
  return step;
}

void step_closely(const std::vector<PlannedSite>& sites, const std::vector<SiteMeasurement>& found, const Prior& prior,
                  CloseStep& step, std::vector<double>& scratch, const ParameterVector& start) {
  step.change = start;
  step.residual_px.assign(sites.size(), 0.0);
  step.weight.assign(sites.size(), 0.0);
  step.spread_px.clear();
  for (std::size_t i = 0; i < sites.size(); ++i) step.spread_px.push_back(spread_of(sites[i], found[i]));
  step.dropped.fill(false);
  iterate(sites, found, prior, step, scratch);
  for (int k = 0; k < 3 && drop_strangers(sites, found, step); ++k) iterate(sites, found, prior, step, scratch);
}

ParameterMatrix covariance_of(const std::vector<PlannedSite>& sites, const CloseStep& step, const Prior& prior,
                              double shared_px) {
  const ParameterMatrix inverse = step.information.ldlt().solve(ParameterMatrix::Identity());
  ParameterMatrix scatter = ParameterMatrix::Zero();
  ParameterVector stretch_pull = ParameterVector::Zero();
  ParameterVector feature_pull = ParameterVector::Zero();
  int stretches = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double spread = step.scale * step.spread_px[i];
    const double w = step.weight[i] / (spread * spread);
    stretch_pull += w * step.residual_px[i] * sites[i].along.transpose();
    feature_pull += w * shared_px * sites[i].along.transpose();
    const bool last = i + 1 == sites.size();
    const bool feature_ends = last || sites[i + 1].feature != sites[i].feature;
    if (feature_ends || sites[i + 1].stretch != sites[i].stretch) {
      if (!stretch_pull.isZero()) ++stretches;
      scatter += stretch_pull * stretch_pull.transpose();
      stretch_pull.setZero();
    }
    if (feature_ends) {
      scatter += feature_pull * feature_pull.transpose();
      feature_pull.setZero();
    }
  }
  // As many stretches are used up as parameters are told by what was seen, not by the prior.
  const double told = parameter::count - (inverse * prior.information).trace();
  const double lost = stretches > 1.33 * told ? stretches / (stretches - told) : 4.0;
  ParameterMatrix covariance = inverse * (lost * scatter + prior.information) * inverse;
  // Never surer than independent sites would make it.
  for (int k = 0; k < parameter::count; ++k) {
    const double least = inverse(k, k) / std::max(covariance(k, k), 1e-30);
    if (least > 1.0) {
      covariance.row(k) *= std::sqrt(least);
      covariance.col(k) *= std::sqrt(least);
    }
  }
  return covariance;
}

}  // namespace hogline::vision
