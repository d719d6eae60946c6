// One throw of a campaign as a line of its table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "src/campaign/plan.hpp"
#include "src/throwing/throw_result.hpp"

namespace hogline::campaign {

/// Errors are "what it was" less "what it should have been"; empty where the throw did not come that far.
struct Row {
  int number = 0;
  std::uint64_t seed = 0;
  double speed_mps = 0.0;  ///< as ordered
  double heading_deg = 0.0;
  double spin_radps = 0.0;  ///< as ordered, counter-clockwise positive
  bool ok = false;
  bool released = false;
  bool hog_line_violation = false;
  bool stone_burned = false;
  std::optional<double> place_error_mm;  ///< positive: released before its place
  std::optional<double> speed_error_mmps;
  std::optional<double> heading_error_deg;
  std::optional<double> lateral_error_mm;
  std::optional<double> spin_error_percent;
  std::optional<double> yaw_after_alignment_deg;
  std::optional<double> delay_believed_ms;  ///< of the jaws, when the release was timed
  std::optional<double> delay_measured_ms;  ///< ... and as they then reported it
  std::optional<double> alignment_s;        ///< how long the turn took
  std::optional<double> rest_x_m;           ///< of the stone, in e
  std::optional<double> rest_y_m;
  double stop_hog_distance_m = 0.0;  ///< where the robot came to rest
  double simulated_s = 0.0;
  std::string abort;  ///< empty: none
};

Row row_of(const Draw& draw, const ThrowResult& result);

/// The table's first line, without its end.
std::string header();
/// A row as a line, without its end. Numbers are written such that reading gives them back to the last bit.
std::string line_of(const Row& row);
/// Nothing when the line is no whole row.
std::optional<Row> parse_row(std::string_view line);

}  // namespace hogline::campaign
