// From places with votes to stones down the sheet: each by itself, then what nearer stones may hide, then all together.
// The far view's; crowds in the near view are crowd_screening's.
#pragma once

#include <vector>

#include "vision/detect/stone_picture.hpp"
#include "vision/detect/stone_team.hpp"
#include "vision/fit/stone_fit.hpp"
#include "vision/stone_looks.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {

struct ScreeningOptions {
  StoneFitOptions first{
      .iterations = 2, .fit_shape = false, .covariance = false, .pixels = 120};  ///< of each by itself
  StoneFitOptions hidden{
      .iterations = 3, .fit_shape = false, .covariance = false, .pixels = 200};  ///< of what may be hidden
  StoneFitOptions close{.iterations = 5, .fit_shape = false, .pixels = 200};     ///< of what may be another's
  StoneFitOptions all{};                                                         ///< of all together
  double hiding_m = stones_hide_m;  ///< a stone farther behind another is seen over it
};

/// Keeps its memory from picture to picture.
class StoneScreening {
 public:
  explicit StoneScreening(const ScreeningOptions& options = {}) : options_(options) {}

  /// Stones of the candidates, in the candidates' order; what is none keeps its doubt. `nearer` are known already, and
  /// may hide these.
  std::vector<JudgedStone> judge(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                                 const std::vector<KnownStone>& nearer = {});

  /// The fit of all that are without doubt together, with the shape they share; some are doubted after it.
  void refine(const StonePicture& picture, std::vector<JudgedStone>& stones,
              const std::vector<KnownStone>& nearer = {});

 private:
  std::vector<JudgedStone> screen(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                                  const std::vector<KnownStone>& nearer);
  void settle_close(const StonePicture& picture, std::vector<JudgedStone>& stones);
  std::vector<KnownStone> look_behind(const StonePicture& picture, const std::vector<KnownStone>& known,
                                      const std::vector<KnownStone>& newest, std::vector<JudgedStone>& stones);

  ScreeningOptions options_;
  StoneFitter fitter_;
};

}  // namespace hogline::vision
