// Writes down what happened on the rink and what the skip believed, while a throw goes on.
#pragma once

#include "src/skip/simulated_skip.hpp"

namespace hogline {

class SkipRecord {
 public:
  /// Request and robot must outlive it.
  SkipRecord(const SkipRequest& request, const SimulatedSkip& robot);

  /// After each control period.
  void note(const SkipLoop& loop, Stamp now);
  /// Lets what still runs come to rest, and judges it.
  SkipOutcome outcome(const SkipLoop& loop) const;

 private:
  struct Margins {
    double side_m = 1e9;
    double back_m = 1e9;
  };
  void follow_margins(const hw::sim::StoneField& field, std::vector<Margins>& margins) const;
  TrueStone judged(const hw::sim::StoneField& field, std::size_t i, const Margins& margins) const;

  const SkipRequest& request_;
  const SimulatedSkip& robot_;
  std::vector<SkipSample> samples_;
  std::vector<Margins> margins_;
  std::optional<Stamp> far_hog_;
  std::optional<double> hog_to_hog_s_;
  double last_y_m_ = 1e9;
  Stamp last_stamp_{};
  Stamp next_sample_{};
};

}  // namespace hogline
