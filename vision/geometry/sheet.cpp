#include "vision/geometry/sheet.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::vision {
namespace {

using namespace rules;
constexpr double half_thin = thin_line_width_m / 2.0;

constexpr std::array<CrossLine, 6> lines{{
    {"back_line", -tee_to_back_m, -tee_to_back_m + thin_line_width_m},
    {"tee_line", -half_thin, half_thin},
    {"hog_line", tee_to_hog_m, tee_to_hog_m + hog_line_width_m},
    {"far_hog_line", tee_to_tee_m - tee_to_hog_m - hog_line_width_m, tee_to_tee_m - tee_to_hog_m},
    {"far_tee_line", tee_to_tee_m - half_thin, tee_to_tee_m + half_thin},
    {"far_back_line", tee_to_tee_m + tee_to_back_m - thin_line_width_m, tee_to_tee_m + tee_to_back_m},
}};

}  // namespace

std::span<const CrossLine> cross_lines() { return lines; }

const CrossLine& cross_line(std::string_view name) {
  const auto found = std::find_if(lines.begin(), lines.end(), [name](const CrossLine& l) { return l.name == name; });
  assert(found != lines.end());
  return *found;
}

}  // namespace hogline::vision
