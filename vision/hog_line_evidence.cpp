#include "vision/hog_line_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

using Light = Eigen::Vector3f;

constexpr double half_width_m = 2.1;  // of the narrowest sheet, nearly
constexpr double clear_of_centre_m = 0.06;
constexpr double column_step_px = 8.0;
constexpr double blurred_px = 2.0;        // what lies so close to an edge may be of both sides
constexpr double wide_px = 6.0;           // from here on its two edges are seen each for itself
constexpr float least_contrast = 0.012F;  // of full light
constexpr float unlike_sides = 0.6F;      // of the contrast
constexpr float unlike_ice = 0.35F;       // of the ice's own light
constexpr int fewest_columns = 16;
constexpr double least_seen = 0.3;
constexpr double most_bare = 0.3;
constexpr int fewest_of_a_half = 8;
constexpr int tangent_px = 3;  // each look is a mean over so many to either side

std::optional<Light> light_at(const Picture& picture, const ResponseCurve& response, const Eigen::Vector2d& pixel,
                              const Eigen::Vector2d& normal) {
  Profile one;
  if (!sample(picture, response, {pixel, normal, 0.0, 0.0, 1.0, tangent_px}, one)) return std::nullopt;
  Light light = Light::Zero();
  for (int c = 0; c < one.channels; ++c) light[c] = one.light[static_cast<std::size_t>(c)][0];
  return light;
}

/// One cut through the line.
struct Column {
  double x_m = 0.0;
  Light ice = Light::Zero();    ///< beside the line
  Light paint = Light::Zero();  ///< less the ice
  float sides = 0.0F;           ///< how far the two sides differ
  /// Far outside, far inside, near inside, near outside, less the ice; of a wide line.
  Eigen::Matrix<float, 3, 4> edges = Eigen::Matrix<float, 3, 4>::Zero();
  bool wide = false;
};

class Cutter {
 public:
  Cutter(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera)
      : picture_(picture), response_(response), camera_(camera) {}

  /// Nothing where the picture does not show the line with its sides.
  std::optional<Column> cut(double x_m) const {
    constexpr double beside_m = 0.02;
    const auto near = camera_.project_paint({x_m, rules::tee_to_hog_m});
    const auto far = camera_.project_paint({x_m, rules::tee_to_hog_m + rules::hog_line_width_m});
    const auto beside = camera_.project_paint({x_m + beside_m, rules::tee_to_hog_m});
    if (!near || !far || !beside) return std::nullopt;
    const Eigen::Vector2d along = (*beside - *near).normalized();
    const Eigen::Vector2d up(along.y(), -along.x());
    const double width = up.dot(*far - *near);
    if (!(width > 0.1)) return std::nullopt;
    const Eigen::Vector2d middle = *near + 0.5 * width * up;
    const double half = 0.5 * width;
    const double side = half + blurred_px + std::max(1.0, 0.15 * width);
    const auto at = [&](double t) { return light_at(picture_, response_, middle + t * up, up); };
    const auto inside = at(0.0);
    const auto before = at(-side);
    const auto after = at(side);
    if (!inside || !before || !after) return std::nullopt;
    const Light ice = 0.5F * (*before + *after);
    Column c;
    c.x_m = x_m;
    c.ice = ice;
    c.paint = *inside - ice;
    c.sides = (*after - *before).norm();
    c.wide = width > wide_px;
    if (!c.wide) return c;
    const double margin = std::max(0.18 * width, 1.5);
    int k = 0;
    for (const double t : {half + margin, half - margin, -half + margin, -half - margin}) {
      const auto light = at(t);
      if (!light) return std::nullopt;
      c.edges.col(k++) = *light - ice;
    }
    return c;
  }

  const SheetCamera& camera() const { return camera_; }

 private:
  const Picture& picture_;
  const ResponseCurve& response_;
  const SheetCamera& camera_;
};

// Evenly spaced in the picture.
std::vector<Column> cut_all(const Cutter& cutter) {
  std::vector<Column> columns;
  double step_m = 0.02;
  for (double x = -half_width_m; x < half_width_m; x += step_m) {
    const auto a = cutter.camera().project_paint({x, rules::tee_to_hog_m});
    const auto b = cutter.camera().project_paint({x + 0.02, rules::tee_to_hog_m});
    step_m = a && b ? std::clamp(0.02 * column_step_px / std::max((*b - *a).norm(), 1e-3), 0.004, 0.1) : 0.02;
    if (std::abs(x) < clear_of_centre_m) continue;
    if (const auto column = cutter.cut(x)) columns.push_back(*column);
  }
  return columns;
}

// The paint's colour against the ice's, and how strong it is as a rule.
struct Paint {
  Light direction = Light::Zero();
  float contrast = 0.0F;
};

Paint paint_of(const std::vector<Column>& columns) {
  Paint paint;
  for (const Column& c : columns) paint.direction += c.paint;
  paint.direction.normalize();
  std::vector<float> along;
  for (const Column& c : columns) along.push_back(c.paint.dot(paint.direction));
  const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
  std::nth_element(along.begin(), middle, along.end());
  paint.contrast = *middle;
  return paint;
}

enum class Look { line, even, hidden };

Look look_of(const Column& c, const Paint& paint) {
  const float along = c.paint.dot(paint.direction);
  if (c.paint.norm() < 0.3F * paint.contrast && c.sides < 0.5F * paint.contrast) return Look::even;
  if (along < 0.4F * paint.contrast || along < (c.wide ? 0.85F : 0.6F) * c.paint.norm()) return Look::hidden;
  if (c.sides > unlike_sides * along) return Look::hidden;
  if (!c.wide) return Look::line;
  const auto share = [&](int k) { return c.edges.col(k).dot(paint.direction) / along; };
  const bool both_edges = share(0) < 0.5F && share(1) > 0.5F && share(2) > 0.5F && share(3) < 0.5F;
  return both_edges ? Look::line : Look::hidden;
}

// The other end's house lies beyond its hog line, ours before it: the half of its outer ring that faces us lies darker
// between the ice around it and the white ring inside it, wherever one looks.
bool house_beyond(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera) {
  const Eigen::Vector2d tee(0.0, 2.0 * rules::tee_to_hog_m + rules::hog_line_width_m);
  const double ice_m = rules::outer_ring_radius_m + 0.25;
  const double ring_m = 0.5 * (rules::outer_ring_radius_m + rules::middle_ring_radius_m);
  const double white_m = 0.5 * (rules::middle_ring_radius_m + rules::inner_ring_radius_m);
  constexpr int directions = 17;
  int looked = 0;
  int rings = 0;
  for (int k = 1; k < directions; ++k) {
    const double angle = -std::numbers::pi * (k - 0.25) / directions;  // none along the centre line
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const auto look = [&](double radius) -> std::optional<Light> {
      const auto pixel = camera.project_paint(tee + radius * out);
      return pixel ? light_at(picture, response, *pixel, {0.0, 1.0}) : std::nullopt;
    };
    const auto ice = look(ice_m);
    const auto ring = look(ring_m);
    const auto white = look(white_m);
    if (!ice || !ring || !white) continue;
    ++looked;
    const float darker = -(*ring - *ice).minCoeff();
    if (darker > 0.08F * ice->norm() && -(*ring - *white).minCoeff() > 0.5F * darker) ++rings;
  }
  return looked >= 8 && rings > 0.75 * looked;
}

}  // namespace

HogLineEvidence weigh_hog_line(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera) {
  HogLineEvidence evidence;
  const std::vector<Column> columns = cut_all(Cutter(picture, response, camera));
  if (columns.empty()) return evidence;
  const Paint paint = paint_of(columns);
  if (paint.contrast < least_contrast) return evidence;
  std::vector<Look> looks;
  Light ice = Light::Zero();
  int lines = 0;
  for (const Column& c : columns) {
    looks.push_back(look_of(c, paint));
    if (looks.back() != Look::line) continue;
    ice += c.ice;
    ++lines;
  }
  ice /= static_cast<float>(std::max(lines, 1));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    HogLineHalf& half = columns[i].x_m < 0.0 ? evidence.left : evidence.right;
    const bool bare = looks[i] == Look::even && (columns[i].ice - ice).norm() < unlike_ice * ice.norm();
    ++half.looked;
    half.seen += looks[i] == Look::line ? 1 : 0;
    half.bare += bare ? 1 : 0;
  }
  evidence.house_beyond = house_beyond(picture, response, camera);
  return evidence;
}

std::string doubt(const HogLineEvidence& evidence) {
  const int looked = evidence.left.looked + evidence.right.looked;
  const int seen = evidence.left.seen + evidence.right.seen;
  if (looked < fewest_columns) return "too little of the hog line is in the picture";
  if (seen < least_seen * looked) return "what lies across is not as a hog line should be";
  for (const HogLineHalf& half : {evidence.left, evidence.right}) {
    if (half.looked >= fewest_of_a_half && half.bare > most_bare * half.looked) {
      return "what lies across ends within the sheet";
    }
  }
  if (evidence.house_beyond) return "a house lies beyond the line: it is the other end's";
  return {};
}

}  // namespace hogline::vision
