#include "vision/hog_line_evidence.hpp"

#include <algorithm>
#include <array>
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
constexpr double surely_seen_m = 5.5;
constexpr int fewest_cuts = 16;
constexpr double least_seen = 0.3;
constexpr double most_bare = 0.12;
constexpr double outermost_m = 0.35;  // the outermost piece of a half
constexpr int fewest_of_an_end = 3;
constexpr double most_bare_end = 0.6;
constexpr int fewest_of_a_half = 8;
constexpr int fewest_beyond = 6;
constexpr double least_beyond = 0.2;
constexpr double most_bare_beyond = 0.34;
constexpr double least_ice_beyond = 0.4;
constexpr int fewest_of_a_ring = 5;
constexpr double most_bare_ring = 0.5;

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
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool left = hog.at_m[i] < 0.0;
    count(looks[i], left ? evidence.left : evidence.right);
    if (std::abs(hog.at_m[i]) > half_width_m - outermost_m)
      count(looks[i], left ? evidence.left_end : evidence.right_end);
  }
}

// Beside rings and other lines; they are of other colours.
void weigh_centre(const LineCutter& cutter, HogLineEvidence& evidence) {
  const auto alone = [](double y) {
    if (std::abs(y) < rules::outer_ring_radius_m + clear_m) return false;
    return std::ranges::none_of(cross_lines(), [y](const CrossLine& line) {
      return y > line.near_edge_y_m - clear_m && y < line.far_edge_y_m + clear_m;
    });
  };
  const double camera_y_m = cutter.camera().eMc().translation().y();
  const Cuts centre = cut_along(cutter, camera_y_m + 0.1, camera_y_m + farthest_m, centre_line_at, alone);
  const std::vector<LineLook> looks = looks_of(centre.cuts);
  for (std::size_t i = 0; i < centre.cuts.size(); ++i) {
    const LineLook look = looks.empty() ? LineLook::hidden : looks[i];
    const double y = centre.at_m[i];
    count(look, evidence.centre);
    if (y > rules::tee_to_hog_m && y < camera_y_m + surely_seen_m) count(look, evidence.beyond);
  }
}

using Light = Eigen::Vector3f;

// The same stuff in whatever light: lamps and the lens make ice lighter and darker, but hardly of another colour.
bool like_ice(const Light& seen, const Light& ice) {
  const float ratio = seen.norm() / std::max(ice.norm(), 1e-6F);
  return ratio > 0.55F && ratio < 1.6F && seen.dot(ice) > 0.985F * seen.norm() * ice.norm();
}

// Ice beside the hog line; nothing where no cut shows the line.
std::optional<Light> ice_beside(const LineCutter& cutter) {
  const Cuts hog =
      cut_along(cutter, -half_width_m, half_width_m, hog_line_at, [](double x) { return std::abs(x) > clear_m; });
  const std::vector<LineLook> looks = looks_of(hog.cuts);
  Light sum = Light::Zero();
  for (std::size_t i = 0; i < looks.size(); ++i) sum += looks[i] == LineLook::line ? hog.cuts[i].ice : Light::Zero();
  if (sum.isZero()) return std::nullopt;
  return sum / static_cast<float>(std::ranges::count(looks, LineLook::line));
}

std::optional<Light> light_on(const LineCutter& cutter, const Eigen::Vector2d& place) {
  const auto pixel = cutter.camera().project_paint(place);
  return pixel ? cutter.light_at(*pixel, {1.0, 0.0}) : std::nullopt;
}

double share_of_ice_beyond(const LineCutter& cutter, const Light& ice) {
  int looked = 0;
  int seen = 0;
  for (const double y : {0.5, 0.9, 1.4, 2.0, 2.8}) {
    for (double x = -1.75; x < 2.0; x += 0.5) {
      const auto light = light_on(cutter, {x, rules::tee_to_hog_m + rules::hog_line_width_m + y});
      if (!light) continue;
      ++looked;
      seen += like_ice(*light, ice) ? 1 : 0;
    }
  }
  return looked > 0 ? static_cast<double>(seen) / looked : 0.0;
}

// Our outer ring, on either side of its edge.
void weigh_ring(const LineCutter& cutter, const Light& ice, LineStretch& ring) {
  constexpr int directions = 48;
  constexpr double off_m = 0.12;
  constexpr float unlike = 0.12F;  // of the ice's light, in some colour
  const double camera_y_m = cutter.camera().eMc().translation().y();
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / directions;
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    if (rules::outer_ring_radius_m * out.y() < camera_y_m + 0.1) continue;
    const auto outside = light_on(cutter, (rules::outer_ring_radius_m + off_m) * out);
    const auto inside = light_on(cutter, (rules::outer_ring_radius_m - off_m) * out);
    if (!outside || !inside) continue;
    ++ring.looked;
    if (!like_ice(*outside, ice)) continue;
    const float darker = -(*inside - *outside).minCoeff();
    if (darker > unlike * outside->norm()) ++ring.seen;
    if (darker < 0.5F * unlike * outside->norm() && like_ice(*inside, ice)) ++ring.bare;
  }
}

// What lies where a ring should be, less the ice on either side of it; nothing where something hides that.
using Look = std::optional<Light>;

// Paint of one colour, all round. Noise, mirror images and logos are of many colours, or lie on one side only.
template <std::size_t directions>
bool is_a_ring(const std::array<Look, directions>& looks, float ice) {
  constexpr std::size_t sectors = 3;
  constexpr float least_contrast = 0.15F;  // of the ice's light
  constexpr float most_lighter = 0.1F;
  constexpr int fewest = 5;
  constexpr double least_share = 0.5;
  constexpr double least_share_of_a_sector = 0.34;
  Light paint = Light::Zero();
  int all = 0;
  for (const Look& look : looks) {
    if (!look) continue;
    paint += *look;
    ++all;
  }
  if (all < fewest) return false;
  paint /= static_cast<float>(all);
  if (paint.norm() < least_contrast * ice || paint.maxCoeff() > most_lighter * ice) return false;
  std::array<int, sectors> seen{};
  std::array<int, sectors> alike{};
  for (std::size_t k = 0; k < directions; ++k) {
    if (!looks[k]) continue;
    ++seen[k * sectors / directions];
    if (looks[k]->dot(paint) > 0.5F * std::max(paint.squaredNorm(), paint.norm() * looks[k]->norm())) {
      ++alike[k * sectors / directions];
    }
  }
  const auto all_round = [&](std::size_t k) { return seen[k] < 2 || alike[k] > least_share_of_a_sector * seen[k]; };
  return alike[0] + alike[1] + alike[2] > least_share * all && all_round(0) && all_round(1) && all_round(2);
}

// The other end's house lies beyond its hog line, ours before it: the half of its outer ring that faces us lies darker
// between the ice around it and the white ring inside it, wherever one looks. Far off, where a ring is some rows high,
// it is looked for some rows higher and lower. Logos lie to the left, to the right or before us: rings on all sides.
// Who stands before it hides a part.
bool house_beyond(const LineCutter& cutter, const Light& known_ice) {
  const Eigen::Vector2d tee(0.0, 2.0 * rules::tee_to_hog_m + rules::hog_line_width_m);
  constexpr std::array<double, 3> radii{rules::outer_ring_radius_m + 0.25,
                                        0.5 * (rules::outer_ring_radius_m + rules::middle_ring_radius_m),
                                        0.5 * (rules::middle_ring_radius_m + rules::inner_ring_radius_m)};
  constexpr std::size_t directions = 15;
  constexpr int rows = 7;  // higher and lower
  std::array<std::array<std::optional<Eigen::Vector2d>, 3>, directions> pixels;
  for (std::size_t k = 0; k < directions; ++k) {
    const double angle =
        -std::numbers::pi * (static_cast<double>(k) + 0.75) / directions;  // none along the centre line
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    for (std::size_t i = 0; i < radii.size(); ++i) {
      pixels[k][i] = cutter.camera().project_paint(tee + radii[i] * out);
    }
  }
  for (int row = -rows; row <= rows; ++row) {
    std::array<Look, directions> looks;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const auto& [ice_at, ring_at, white_at] = pixels[k];
      const auto look = [&](const std::optional<Eigen::Vector2d>& pixel) {
        return pixel ? cutter.light_at(*pixel + Eigen::Vector2d(0.0, row), {1.0, 0.0}) : std::nullopt;
      };
      const auto ice = look(ice_at);
      const auto ring = look(ring_at);
      const auto white = look(white_at);
      if (!ice || !ring || !white || !like_ice(*ice, known_ice) || !like_ice(*white, known_ice)) continue;
      looks[k] = *ring - 0.5F * (*ice + *white);
    }
    if (is_a_ring(looks, known_ice.norm())) return true;
  }
  return false;
}

}  // namespace

HogLineEvidence weigh_hog_line(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera) {
  const LineCutter cutter(picture, response, camera);
  HogLineEvidence evidence;
  weigh_halves(cutter, evidence);
  weigh_centre(cutter, evidence);
  if (const auto ice = ice_beside(cutter)) {
    evidence.ice_beyond = share_of_ice_beyond(cutter, *ice);
    weigh_ring(cutter, *ice, evidence.ring);
    evidence.house_beyond = house_beyond(cutter, *ice);
  }
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
  for (const LineStretch& end : {evidence.left_end, evidence.right_end}) {
    if (end.looked >= fewest_of_an_end && end.bare > most_bare_end * end.looked) {
      return "what lies across ends within the sheet";
    }
  }
  if (evidence.centre.looked >= fewest_cuts && evidence.centre.seen < least_seen * evidence.centre.looked) {
    return "the centre line is not where the pose puts it";
  }
  if (evidence.ice_beyond < least_ice_beyond) return "no ice lies beyond what lies across";
  const LineStretch& beyond = evidence.beyond;
  if (beyond.looked >= fewest_beyond && beyond.seen < least_beyond * beyond.looked &&
      beyond.bare > most_bare_beyond * beyond.looked) {
    return "the centre line does not go on beyond what lies across";
  }
  if (evidence.ring.looked >= fewest_of_a_ring && evidence.ring.bare > most_bare_ring * evidence.ring.looked) {
    return "bare ice lies where the rings should be";
  }
  if (evidence.house_beyond) return "a house lies beyond the line: it is the other end's";
  return {};
}

}  // namespace hogline::vision
