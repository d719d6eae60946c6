#include "vision/fit/joint_solver.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hogline::vision {
namespace {

struct Problem {
  std::vector<PlannedSite> sites;
  std::vector<SiteMeasurement> found;
  ParameterVector truth = ParameterVector::Zero();
};

// Sites that each see some mixture of the parameters, measured with 0.1 px of noise; some of them are elsewhere.
Problem problem(unsigned seed, double outlier_share) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Problem p;
  for (int k = 0; k < parameter::count; ++k) p.truth[k] = 0.01 * normal(generator);
  for (int i = 0; i < 400; ++i) {
    PlannedSite site;
    site.feature = i / 100;
    site.stretch = i / 10;
    for (int k = 0; k < parameter::count; ++k) site.along[k] = 100.0 * normal(generator);
    SiteMeasurement m;
    m.found = true;
    m.sigma_px = 0.1;
    const bool outlier = uniform(generator) < outlier_share;
    m.offset_px = site.along.dot(p.truth) + 0.1 * normal(generator) + (outlier ? 4.0 + 3.0 * uniform(generator) : 0.0);
    p.sites.push_back(site);
    p.found.push_back(m);
  }
  return p;
}

Prior loose() {
  Prior prior;
  for (int k = 0; k < parameter::count; ++k) prior.add(ParameterRow::Unit(k), 0.0, 10.0);
  return prior;
}

TEST(StepClosely, FindsTheChangeAmongOutliersAndStatesItsSigma) {
  double normalised2 = 0.0;
  int n = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Problem p = problem(seed, 0.25);
    CloseStep step;
    std::vector<double> scratch;
    step_closely(p.sites, p.found, loose(), step, scratch);
    const ParameterMatrix covariance = covariance_of(p.sites, step, loose(), 0.0);
    for (int k = 0; k < parameter::count; ++k) {
      EXPECT_NEAR(step.change[k], p.truth[k], 5.0 * std::sqrt(covariance(k, k)));
      normalised2 += (step.change[k] - p.truth[k]) * (step.change[k] - p.truth[k]) / covariance(k, k);
      ++n;
    }
  }
  EXPECT_NEAR(std::sqrt(normalised2 / n), 1.0, 0.35);
}

TEST(StepClosely, DropsAFeatureThatIsElsewhere) {
  Problem p = problem(3, 0.0);
  for (int i = 300; i < 400; ++i) p.found[static_cast<std::size_t>(i)].offset_px += 2.0 + 0.02 * i;
  CloseStep step;
  std::vector<double> scratch;
  step_closely(p.sites, p.found, loose(), step, scratch);
  EXPECT_TRUE(step.dropped[3]);
  EXPECT_FALSE(step.dropped[0]);
  EXPECT_LT((step.change - p.truth).cwiseAbs().maxCoeff(), 0.001);
}

TEST(Prior, HoldsWhatIsNotSeen) {
  Problem p = problem(5, 0.0);
  for (PlannedSite& site : p.sites) site.along[parameter::depth] = 0.0;
  Prior prior = loose();
  prior.add(ParameterRow::Unit(parameter::depth), 0.002, 1e-4);
  CloseStep step;
  std::vector<double> scratch;
  step_closely(p.sites, p.found, prior, step, scratch);
  EXPECT_NEAR(step.change[parameter::depth], 0.002, 1e-6);
}

TEST(StepWidely, ChoosesAmongCandidatesAndIsTheSameEachTime) {
  const Problem p = problem(7, 0.0);
  std::vector<Candidates> seen;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-20.0, 20.0);
  std::vector<PlannedSite> sites = p.sites;
  for (PlannedSite& site : sites) {
    site.along.tail<5>().setZero();
    Candidates c;
    c.count = 3;
    c.at[0] = {uniform(generator), 1.0};
    c.at[1] = {site.along.dot(p.truth), 0.9};
    c.at[2] = {uniform(generator), 0.5};
    seen.push_back(c);
  }
  Eigen::Matrix<double, 6, 1> sigma;
  sigma.setConstant(0.01);
  const WideStep step = step_widely(sites, seen, loose(), Consensus{sigma, 0});
  EXPECT_LT((step.change - p.truth).head<6>().cwiseAbs().maxCoeff(), 0.002);
  EXPECT_GT(step.agreeing_share, 0.9);
  EXPECT_EQ(step.change, step_widely(sites, seen, loose(), Consensus{sigma, 0}).change);
}

}  // namespace
}  // namespace hogline::vision
