#include "vision/hog_line_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "vision/geometry/sheet.hpp"
#include "vision/line_cut.hpp"

namespace hogline::vision {
namespace {

constexpr double half_width_m = 2.1;  // of the narrowest sheet, nearly
constexpr double clear_m = 0.06;      // of other lines
constexpr double step_px = 8.0;
constexpr double farthest_m = 8.0;  // from the camera, of the centre line
constexpr int fewest_cuts = 16;
constexpr double least_seen = 0.3;
constexpr double most_bare = 0.3;
constexpr int fewest_of_a_half = 8;

/// Cuts along a line, evenly spaced in the picture, and where they were made.
struct Cuts {
  std::vector<LineCut> cuts;
  std::vector<double> at_m;
};

/// `place_at(u)` is the line's place at u, `use(u)` says whether to cut there.
template <typename PlaceAt, typename Use>
Cuts cut_along(const LineCutter& cutter, double begin_m, double end_m, const PlaceAt& place_at, const Use& use) {
  constexpr double probe_m = 0.02;
  Cuts found;
  double step_m = probe_m;
  for (double u = begin_m; u < end_m; u += step_m) {
    const auto a = cutter.camera().project_paint(place_at(u).first_edge);
    const auto b = cutter.camera().project_paint(place_at(u + probe_m).first_edge);
    step_m = a && b ? std::clamp(probe_m * step_px / std::max((*b - *a).norm(), 1e-3), 0.004, 0.25) : probe_m;
    if (!use(u)) continue;
    if (const auto cut = cutter.cut(place_at(u))) {
      found.cuts.push_back(*cut);
      found.at_m.push_back(u);
    }
  }
  return found;
}

LinePlace hog_line_at(double x_m) { return {{x_m, rules::tee_to_hog_m}, {0.0, rules::hog_line_width_m}, {1.0, 0.0}}; }

LinePlace centre_line_at(double y_m) {
  return {{-0.5 * rules::thin_line_width_m, y_m}, {rules::thin_line_width_m, 0.0}, {0.0, 1.0}};
}

void count(LineLook look, LineStretch& stretch) {
  ++stretch.looked;
  stretch.seen += look == LineLook::line ? 1 : 0;
  stretch.bare += look == LineLook::bare ? 1 : 0;
}

void weigh_halves(const LineCutter& cutter, HogLineEvidence& evidence) {
  const Cuts hog =
      cut_along(cutter, -half_width_m, half_width_m, hog_line_at, [](double x) { return std::abs(x) > clear_m; });
  const std::vector<LineLook> looks = looks_of(hog.cuts);
  for (std::size_t i = 0; i < looks.size(); ++i) count(looks[i], hog.at_m[i] < 0.0 ? evidence.left : evidence.right);
}

// Beside rings and other lines; they are of other colours.
LineStretch weigh_centre(const LineCutter& cutter) {
  const auto alone = [](double y) {
    if (std::abs(y) < rules::outer_ring_radius_m + clear_m) return false;
    return std::ranges::none_of(cross_lines(), [y](const CrossLine& line) {
      return y > line.near_edge_y_m - clear_m && y < line.far_edge_y_m + clear_m;
    });
  };
  const double camera_y_m = cutter.camera().eMc().translation().y();
  const Cuts centre = cut_along(cutter, camera_y_m + 0.1, camera_y_m + farthest_m, centre_line_at, alone);
  LineStretch stretch;
  for (const LineLook look : looks_of(centre.cuts)) count(look, stretch);
  stretch.looked = static_cast<int>(centre.cuts.size());
  return stretch;
}

// The other end's house lies beyond its hog line, ours before it: the half of its outer ring that faces us lies darker
// between the ice around it and the white ring inside it, wherever one looks.
bool house_beyond(const LineCutter& cutter) {
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
    const auto look = [&](double radius) -> std::optional<Eigen::Vector3f> {
      const auto pixel = cutter.camera().project_paint(tee + radius * out);
      return pixel ? cutter.light_at(*pixel, {1.0, 0.0}) : std::nullopt;
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
  const LineCutter cutter(picture, response, camera);
  HogLineEvidence evidence;
  weigh_halves(cutter, evidence);
  evidence.centre = weigh_centre(cutter);
  evidence.house_beyond = house_beyond(cutter);
  return evidence;
}

std::string doubt(const HogLineEvidence& evidence) {
  const int looked = evidence.left.looked + evidence.right.looked;
  const int seen = evidence.left.seen + evidence.right.seen;
  if (looked < fewest_cuts || seen < least_seen * looked) return "what lies across is not as a hog line should be";
  for (const LineStretch& half : {evidence.left, evidence.right}) {
    if (half.looked >= fewest_of_a_half && half.bare > most_bare * half.looked) {
      return "what lies across ends within the sheet";
    }
  }
  if (evidence.centre.looked >= fewest_cuts && evidence.centre.seen < least_seen * evidence.centre.looked) {
    return "the centre line is not where the pose puts it";
  }
  if (evidence.house_beyond) return "a house lies beyond the line: it is the other end's";
  return {};
}

}  // namespace hogline::vision
