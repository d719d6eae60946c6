#include "vision/fit/painted_features.hpp"

#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double half_narrowest_m = rules::min_width_m / 2.0;

PaintedFeature circle(const char* name, double radius_m, bool coarse) {
  return {.name = name,
          .shape = PaintedFeature::Shape::circle,
          .at_m = radius_m,
          .begin_m = -std::numbers::pi,
          .end_m = std::numbers::pi,
          .coarse = coarse};
}

PaintedFeature across(const CrossLine& line, bool coarse) {
  return {.name = std::string(line.name),
          .shape = PaintedFeature::Shape::across,
          .at_m = line.centre_y_m(),
          .width_m = line.width_m(),
          .begin_m = -half_narrowest_m,
          .end_m = half_narrowest_m,
          .coarse = coarse};
}

}  // namespace

std::vector<PaintedFeature> fixed_features() {
  std::vector<PaintedFeature> features{circle("outer_ring", rules::outer_ring_radius_m, true),
                                       circle("middle_ring", rules::middle_ring_radius_m, true),
                                       circle("inner_ring", rules::inner_ring_radius_m, true)};
  for (const CrossLine& line : cross_lines()) features.push_back(across(line, line.name == "hog_line"));
  features.push_back({.name = "centre_line",
                      .shape = PaintedFeature::Shape::down_ice,
                      .at_m = 0.0,
                      .width_m = rules::thin_line_width_m,
                      .begin_m = centre_line_begin_y_m,
                      .end_m = centre_line_end_y_m,
                      .coarse = true});
  return features;
}

PaintedFeature sideline(PaintedFeature::Place place, double width_m) {
  const bool left = place == PaintedFeature::Place::left_sideline;
  return {.name = left ? "left_sideline" : "right_sideline",
          .shape = PaintedFeature::Shape::down_ice,
          .place = place,
          .at_m = (left ? -0.5 : 0.5) * width_m,
          .begin_m = centre_line_begin_y_m,
          .end_m = centre_line_end_y_m};
}

CurvePoint point_on(const PaintedFeature& feature, double parameter) {
  switch (feature.shape) {
    case PaintedFeature::Shape::circle: {
      const Eigen::Vector2d outward(std::cos(parameter), std::sin(parameter));
      return {feature.at_m * outward, feature.at_m * Eigen::Vector2d(-outward.y(), outward.x()), outward};
    }
    case PaintedFeature::Shape::across:
      return {{parameter, feature.at_m}, {1.0, 0.0}, {0.0, 1.0}};
    case PaintedFeature::Shape::down_ice:
      break;
  }
  return {{feature.at_m, parameter}, {0.0, 1.0}, {1.0, 0.0}};
}

Eigen::Vector2d towards(const PaintedFeature& feature, const Eigen::Vector2d& point) {
  switch (feature.shape) {
    case PaintedFeature::Shape::circle: {
      const double radius = point.norm();
      return radius > 0.0 ? Eigen::Vector2d((feature.at_m - radius) / radius * point)
                          : Eigen::Vector2d(feature.at_m, 0.0);
    }
    case PaintedFeature::Shape::across:
      return {0.0, feature.at_m - point.y()};
    case PaintedFeature::Shape::down_ice:
      break;
  }
  return {feature.at_m - point.x(), 0.0};
}

}  // namespace hogline::vision
