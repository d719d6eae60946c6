#include "src/faults/trial_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::faults {
namespace {

void expect(Finding& finding, bool fine, std::string what) {
  if (!fine) finding.failures.push_back(std::move(what));
}

void judge_stop(const Case& fault, Finding& finding) {
  const double detected_s = finding.detected_after_s.value_or(1e9);
  expect(finding, detected_s <= seconds(fault.deadline),
         finding.detected_after_s ? fmt::format("detected after {:.0f} ms", 1e3 * detected_s)
                                  : std::string("not detected"));
  expect(finding, finding.stopped_after_s.has_value(), "the robot did not stop");
  expect(finding, finding.log.find(fault.says) != std::string::npos, "the log does not say \"" + fault.says + "\"");
  if (fault.expect == Expect::brakes_after) {
    expect(finding, finding.result.release && !finding.result.hog_line_violation && !finding.result.stone_burned,
           "the stone was not let go in its window");
  } else {
    expect(finding, finding.held || fault.expect == Expect::stops_without_stone, "the stone was not kept");
    expect(finding, !finding.over_the_line || fault.strike == Strike::too_late,
           "the stone was carried into the hog line");
  }
  // Reaction, the quick stop's ramp of 2.5 m/s2, and its lag.
  const double v = finding.speed_mps;
  const double blind_s = std::min(detected_s, 1.0) + (fault.strike == Strike::braking ? 0.25 : 0.1);
  const double limit_m = fault.stop_limit_m > 0.0 ? fault.stop_limit_m : v * blind_s + v * v / (2.0 * 2.5) + 0.15;
  finding.braked = finding.stopped_after_s.has_value() && finding.stop_distance_m <= limit_m;
  expect(finding, finding.stop_distance_m <= limit_m,
         fmt::format("took {:.2f} m to stop, {:.2f} m allowed", finding.stop_distance_m, limit_m));
}

}  // namespace

void judge(const Case& fault, bool struck, Finding& finding) {
  const ThrowResult& r = finding.result;
  expect(finding, struck, "was never injected");
  if (fault.expect == Expect::goes_on) {
    expect(finding, r.ok, "the throw did not succeed: " + finding.log);
    if (!r.release) return;
    constexpr double deg = std::numbers::pi / 180.0;
    expect(finding, std::abs(r.release->hog_distance_m - r.release->target_hog_distance_m) < 0.05,
           "released at a wrong place");
    expect(finding, std::abs(r.release->speed_error_mps) < 0.03, "released at a wrong speed");
    expect(finding, std::abs(r.release->heading_error_rad) < 0.15 * deg, "released at a wrong heading");
    return;
  }
  judge_stop(fault, finding);
  expect(finding, !finding.moved_on_recovery, "something moved when the fault was gone");
  expect(finding, !finding.moved_on_rearming, "something moved when it was re-armed");
  if (fault.heal) expect(finding, finding.ready_again, "is not ready after re-arming");
}

}  // namespace hogline::faults
