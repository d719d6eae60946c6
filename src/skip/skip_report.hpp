// A followed throw as people and programs read it: JSON (doc/skip.md), CSV, and the sheet from above.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "servo/skip.hpp"
#include "servo/throw_fit.hpp"
#include "src/percept_json.hpp"
#include "src/skip/skip_figures.hpp"

namespace hogline {

/// All that is told of a throw.
struct ToldThrow {
  const servo::SkipReport* report = nullptr;
  const servo::SkipDiagnosis* known = nullptr;
  Stamp origin{};                                 ///< times count from here: the release, or the first picture
  std::optional<servo::IceEstimate> ice;          ///< in s, afterwards
  std::optional<servo::StopPrediction> foretold;  ///< where it would stop, as believed at the near hog line
  TeamNames teams;
  std::string seen_by;                 ///< "vision" or "oracle"
  std::optional<int> unread;           ///< of a recording: pictures that could not be loaded
  const SkipOutcome* truth = nullptr;  ///< on the simulated rink
};

/// One JSON object; `indent` -1 for one line.
std::string throw_json(const ToldThrow& told, int indent);
/// A header, then a line for each look of the trajectory.
std::string trajectory_csv(const ToldThrow& told);
/// Trail, where every stone came to lie with its ellipse, and what was foretold of the thrown one.
cv::Mat throw_picture(const ToldThrow& told, int length_px);

/// result.json, trajectory.csv and above.png. Throws std::runtime_error.
void write_throw(const std::string& folder, const ToldThrow& told);

}  // namespace hogline
