#include "vision/fit/site_measurement.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

// Half breadth of the mean along the tangent; an edge seen so bends by less than a pixel.
int most_breadth(const PlannedSite& site) { return std::abs(site.curvature) > 0.02 ? 1 : 2; }

double window_px(const PlannedSite& site, double room_px) { return std::min(room_px, 3.0 * site.blur_px + 3.0); }

}  // namespace

Candidates look_widely(const PictureLight& light, const PlannedSite& site, double search_px, Profile& profile) {
  const double reach = search_px + 0.5 * site.width_px + 4.0 * site.blur_px + 2.0;
  const double step = std::max(1.0, 2.0 * reach / (Profile::max_samples - 2));
  if (!sample(light.picture, light.response, {site.pixel, site.normal, -reach, reach, step, 1}, profile)) return {};
  return site.step ? find_steps(profile, site.blur_px) : find_ridges(profile, site.width_px, site.blur_px);
}

SiteMeasurement look_closely(const PictureLight& light, const PlannedSite& site, double search_px, int half_breadth,
                             Profile& profile) {
  SiteMeasurement m;
  const double before = window_px(site, site.before_px);
  const double after = window_px(site, site.after_px);
  const double half = 0.5 * site.width_px;
  const int breadth = std::min(half_breadth, most_breadth(site));
  // Measured: steps of 0.75 px beat with the pixels and leave 0.015 px of bias, steps of half a pixel 0.001.
  const double step_px = half_breadth > 1 ? 0.5 : 0.75;
  const Cut cut{site.pixel, site.normal, -half - before - search_px, half + after + search_px, step_px, breadth};
  if (!sample(light.picture, light.response, cut, profile)) return m;

  const double blur_px = site.seen_blur_px > 0.0 ? site.seen_blur_px : site.blur_px;
  EdgeExpectation expected{0.0, site.width_px, blur_px, before, after, search_px};
  if (search_px > 1.5) {
    const Candidates seen =
        site.step ? find_steps(profile, site.blur_px) : find_ridges(profile, site.width_px, site.blur_px);
    const auto list = seen.list();
    const auto near = std::find_if(list.begin(), list.end(),
                                   [search_px](const Candidate& c) { return std::abs(c.offset_px) <= search_px; });
    if (near != list.end()) {
      expected.offset_px = near->offset_px;
      expected.max_shift_px = 1.5;
    }
  }
  const LocalEdge edge = locate(profile, expected);
  if (!edge.ok() || std::abs(edge.offset_px) > search_px) return m;

  // A bent edge, blurred and averaged along its tangent, moves towards its inside.
  const double spread2 = edge.blur_px * edge.blur_px + (breadth * (breadth + 1)) / 3.0;
  m.found = true;
  m.offset_px = edge.offset_px - 0.5 * site.curvature * spread2;
  m.sigma_px = edge.sigma_px;
  m.blur_px = edge.blur_px;
  m.contrast = edge.contrast;
  m.colour = edge.colour;
  return m;
}

}  // namespace hogline::vision
