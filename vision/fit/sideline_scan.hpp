// Finding the sidelines' distance from the centre line once the camera's pose is nearly known: the sheet's cross
// section, row by row; each row votes, so that people, stones and lamps in some of them do not count.
#pragma once

#include "vision/fit/fit_parameters.hpp"
#include "vision/fit/site_measurement.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// Between which distances the inner edge is looked for, and in which rows of the sheet.
struct ScanRange {
  double begin_m;
  double end_m;
  double first_row_m = 0.0;  ///< beyond the camera, along the sheet
  double row_step_m = 0.25;
};

/// The innermost line or divider that many rows show on one side (-1 left, 1 right). `known == false` when there is
/// none or too few rows are in view. `as_line`: paint, with its outer edge; otherwise a divider's foot.
Sideline scan_sideline(const PictureLight& light, const SheetCamera& camera, double side, bool as_line,
                       const ScanRange& range);

}  // namespace hogline::vision
