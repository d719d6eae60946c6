#include "tests/bench/contestants.hpp"

#include "tests/bench/hogline_methods.hpp"
#include "tests/bench/hough_chain.hpp"
#include "tests/bench/low_hough_chain.hpp"
#include "tests/bench/visp_lines.hpp"
#include "tests/bench/visp_low_lines.hpp"
#include "tests/bench/visp_model.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::bench {
namespace {

using vision::cross_line;
namespace rules = vision::rules;

// How far down-ice a line is worth following from the near camera: 14 m ahead it is a pixel wide.
constexpr double farthest_y_m = 10.0;

Camera camera_of(const Footage& footage) { return {footage.setup.intrinsics, footage.setup.mount}; }

PaintedLine across(const std::string& name, double y_m, double width_m) {
  return {name, {-width_m / 2.0, y_m}, {width_m / 2.0, y_m}};
}

PaintedLine along(const std::string& name, double x_m) {
  return {name, {x_m, vision::centre_line_begin_y_m}, {x_m, farthest_y_m}};
}

// ViSP's trackers are told the sheet's true width, which they can not find out; hogline finds it.
std::vector<PaintedLine> painted_edges(const Footage& footage) {
  const double w = footage.sheet_width_m;
  std::vector<PaintedLine> lines{
      across("hog line, house side", cross_line("hog_line").near_edge_y_m, w),
      across("hog line, far side", cross_line("hog_line").far_edge_y_m, w),
      across("tee line", cross_line("tee_line").centre_y_m(), w),
      across("back line", cross_line("back_line").centre_y_m(), w),
      along("centre line", 0.0),
  };
  if (footage.sidelines) {
    lines.push_back(along("left sideline", -w / 2.0));
    lines.push_back(along("right sideline", w / 2.0));
  }
  return lines;
}

CrossingLines crossing_lines(const Footage& footage) {
  const double w = footage.sheet_width_m;
  CrossingLines lines;
  lines.across = {across("hog line", cross_line("hog_line").near_edge_y_m, w),
                  across("tee line", cross_line("tee_line").centre_y_m(), w),
                  across("back line", cross_line("back_line").centre_y_m(), w)};
  lines.along = {along("centre line", 0.0)};
  if (footage.sidelines) {
    lines.along.push_back(along("left sideline", -w / 2.0));
    lines.along.push_back(along("right sideline", w / 2.0));
  }
  lines.ring_radius_m = rules::outer_ring_radius_m;
  return lines;
}

}  // namespace

std::vector<Contestant> near_contestants() {
  return {
      {"chain", "paper's chain, plain OpenCV", false, [](const Footage& f) { return make_hough_chain(camera_of(f)); }},
      {"model", "ViSP vpMbGenericTracker", true,
       [](const Footage& f) { return make_visp_model(camera_of(f), painted_edges(f)); }},
      {"lines", "ViSP vpMeLine, vpMeEllipse, vpPose", true,
       [](const Footage& f) { return make_visp_lines(camera_of(f), crossing_lines(f)); }},
      {"acquire", "**hogline acquire**", false, [](const Footage& f) { return make_near_acquire(f.setup); }},
      {"track", "**hogline track**", false, [](const Footage& f) { return make_near_track(f.setup); }},
  };
}

// Both others are told the sheet's true width: the paper measures it with the near view.
std::vector<Contestant> low_contestants() {
  return {
      {"chain", "paper's Hough transform per frame, plain OpenCV", false,
       [](const Footage& f) { return make_low_hough_chain(camera_of(f), f.sheet_width_m); }},
      {"lines", "ViSP vpMeLine", true,
       [](const Footage& f) { return make_visp_low_lines(camera_of(f), f.sheet_width_m); }},
      {"acquire", "**hogline acquire**", false, [](const Footage& f) { return make_low_acquire(f.setup); }},
      {"track", "**hogline track**", false, [](const Footage& f) { return make_low_track(f.setup); }},
  };
}

}  // namespace hogline::bench
