#include "vision/fit/fit_parameters.hpp"

#include <algorithm>

namespace hogline::vision {

FitState moved(const FitState& state, const ParameterVector& change) {
  FitState next = state;
  next.eMc = state.eMc * exp({change.segment<3>(0), change.segment<3>(3)});
  next.eMc.linear() = Eigen::Quaterniond(next.eMc.linear()).normalized().toRotationMatrix();
  next.sidelines[0].edge_m += change[parameter::left_edge];
  next.sidelines[0].paint_m = std::clamp(state.sidelines[0].paint_m + change[parameter::left_paint], 0.005, 0.12);
  next.sidelines[1].edge_m += change[parameter::right_edge];
  next.sidelines[1].paint_m = std::clamp(state.sidelines[1].paint_m + change[parameter::right_paint], 0.005, 0.12);
  next.paint_depth_m = std::clamp(state.paint_depth_m + change[parameter::depth], 0.0, 0.05);
  return next;
}

}  // namespace hogline::vision
