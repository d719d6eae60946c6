#include "vision/line_cut.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

using Light = Eigen::Vector3f;

constexpr double beside_m = 0.02;
constexpr int tangent_px = 3;             // each look is a mean over so many to either side
constexpr double blurred_px = 2.0;        // what lies so close to an edge may be of both sides
constexpr double wide_px = 6.0;           // from here on its two edges are seen each for itself
constexpr float least_contrast = 0.012F;  // of full light
constexpr float lighter = 0.4F;           // of the contrast, in any colour
constexpr float unlike_sides = 0.6F;      // of the contrast
constexpr float unlike_ice = 0.35F;       // of the ice's own light
constexpr float glaring = 0.95F;          // of full light, in every colour: a lamp's reflection hides paint

// The paint's colour against the ice's, and how strong it is as a rule.
struct Paint {
  Light direction = Light::Zero();
  float contrast = 0.0F;
};

Paint paint_of(const std::vector<LineCut>& cuts) {
  Paint paint;
  for (const LineCut& c : cuts) paint.direction += c.paint;
  paint.direction.normalize();
  std::vector<float> along;
  for (const LineCut& c : cuts) along.push_back(c.paint.dot(paint.direction));
  const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
  std::nth_element(along.begin(), middle, along.end());
  paint.contrast = *middle;
  return paint;
}

// Of what is even; whether it is ice is another question.
LineLook look_of(const LineCut& c, const Paint& paint) {
  const float along = c.paint.dot(paint.direction);
  if (c.paint.norm() < 0.3F * paint.contrast && c.sides < 0.5F * paint.contrast) return LineLook::bare;
  if (along < 0.4F * paint.contrast || along < (c.wide ? 0.85F : 0.6F) * c.paint.norm()) return LineLook::hidden;
  if (c.sides > unlike_sides * along) return LineLook::hidden;
  if (!c.wide) return LineLook::line;
  const auto share = [&](int k) { return c.edges.col(k).dot(paint.direction) / along; };
  const bool both_edges = share(0) < 0.5F && share(1) > 0.5F && share(2) > 0.5F && share(3) < 0.5F;
  return both_edges ? LineLook::line : LineLook::hidden;
}

}  // namespace

std::optional<Light> LineCutter::light_at(const Eigen::Vector2d& pixel, const Eigen::Vector2d& tangent) const {
  Profile one;
  const Eigen::Vector2d normal(tangent.y(), -tangent.x());
  if (!sample(picture_, response_, {pixel, normal, 0.0, 0.0, 1.0, tangent_px}, one)) return std::nullopt;
  Light light = Light::Zero();
  for (int c = 0; c < one.channels; ++c) light[c] = one.light[static_cast<std::size_t>(c)][0];
  return light;
}

std::optional<LineCut> LineCutter::cut(const LinePlace& place) const {
  const auto first = camera_.project_paint(place.first_edge);
  const auto second = camera_.project_paint(place.first_edge + place.across);
  const auto next = camera_.project_paint(place.first_edge + beside_m * place.along);
  if (!first || !second || !next) return std::nullopt;
  const Eigen::Vector2d along = (*next - *first).normalized();
  Eigen::Vector2d over(along.y(), -along.x());
  if (over.dot(*second - *first) < 0.0) over = -over;
  const double width = over.dot(*second - *first);
  if (!(width > 0.1)) return std::nullopt;
  const Eigen::Vector2d middle = *first + 0.5 * width * over;
  const double half = 0.5 * width;
  const double side = half + blurred_px + std::max(1.0, 0.15 * width);
  const auto at = [&](double t) { return light_at(middle + t * over, along); };
  const auto inside = at(0.0);
  const auto before = at(-side);
  const auto after = at(side);
  if (!inside || !before || !after) return std::nullopt;
  LineCut c;
  c.ice = 0.5F * (*before + *after);
  c.paint = *inside - c.ice;
  c.sides = (*after - *before).norm();
  c.wide = width > wide_px;
  if (!c.wide) return c;
  const double margin = std::max(0.18 * width, 1.5);
  int k = 0;
  for (const double t : {-half - margin, -half + margin, half - margin, half + margin}) {
    const auto light = at(t);
    if (!light) return std::nullopt;
    c.edges.col(k++) = *light - c.ice;
  }
  return c;
}

std::vector<LineLook> looks_of(const std::vector<LineCut>& cuts) {
  if (cuts.empty()) return {};
  const Paint paint = paint_of(cuts);
  if (paint.contrast < least_contrast) return {};
  // Ice is lighter than any paint: what is lighter than its sides is the ice between two logos.
  if (paint.direction.maxCoeff() > lighter) return std::vector<LineLook>(cuts.size(), LineLook::hidden);
  std::vector<LineLook> looks;
  Light ice = Light::Zero();
  int lines = 0;
  for (const LineCut& c : cuts) {
    looks.push_back(look_of(c, paint));
    if (looks.back() != LineLook::line) continue;
    ice += c.ice;
    ++lines;
  }
  ice /= static_cast<float>(std::max(lines, 1));
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const bool is_ice = (cuts[i].ice - ice).norm() < unlike_ice * ice.norm() && cuts[i].ice.minCoeff() < glaring;
    if (looks[i] == LineLook::bare && !is_ice) looks[i] = LineLook::hidden;
  }
  return looks;
}

}  // namespace hogline::vision
