// Which of the many places where paint is seen a tracker looks at: a given number, everywhere a few and most where they
// tell most of the body's place and direction.
#pragma once

#include <vector>

#include "vision/fit/site_planner.hpp"

namespace hogline::vision {

/// What a choice goes by beside what places tell.
struct ChoiceWishes {
  int certain_feature = -1;   ///< this one is to be verified in every frame, however little it tells; -1: none
  int certain_places = 0;     ///< so many of its places at least, where there are as many
  bool avoid_hidden = false;  ///< few where the feature was looked for round about and not seen: something hides it
};

/// The body's x, y and yaw by the estimated parameters.
using BodyByParameters = Eigen::Matrix<double, 3, parameter::count>;

class PlaceChoice {
 public:
  /// `most_places` of room, so that no memory is needed later.
  PlaceChoice(int wanted_places, std::size_t most_places, const ChoiceWishes& wishes = {});

  /// By the covariance of a fit to all places.
  void judge_by(const ParameterMatrix& covariance, const BodyByParameters& body);

  /// Plans and chooses anew; `sites` are those of before, then the new ones. Precondition: judge_by() came before.
  void choose_all(const SheetCamera& camera, const FitState& state, std::vector<PlannedSite>& sites);

  /// The view changes as the robot moves: plans and chooses one feature anew, the next one each time. `sites` are in
  /// the features' order, before and after.
  void renew_one_feature(const SheetCamera& camera, const FitState& state, std::vector<PlannedSite>& sites);

 private:
  void plan(const SheetCamera& camera, const FitState& state, int feature);
  double tells(const PlannedSite& site) const;
  void keep_chosen(const std::vector<PlannedSite>& before);
  bool hidden(const PlannedSite& site, const std::vector<PlannedSite>& before) const;
  double certainty(const std::vector<PlannedSite>& before) const;

  double wanted_;
  ChoiceWishes wishes_;
  BodyByParameters worth_ = BodyByParameters::Zero();  ///< see tells()
  double even_ = 0.0;                                  ///< what each place counts beside what it tells
  double quantum_ = 1.0;                               ///< each time the counts reach this, a place is taken
  int next_feature_ = 0;
  std::vector<PlannedSite> planned_;
};

}  // namespace hogline::vision
