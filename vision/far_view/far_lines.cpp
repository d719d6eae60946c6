#include "vision/far_view/far_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vision/fit/paint.hpp"

namespace hogline::vision {
namespace {

constexpr double sigmas = 3.2;       // so far either way
constexpr double cell_px = 1.5;      // of the vote, in what the middle of the picture moves
constexpr int half_breadth = 5;      // a site's cut is the mean over so many pixels either way along the line
constexpr int gap_px = 1;            // where line and ice are blurred together
constexpr int side_px = 3;           // ice on either side that is compared with the line
constexpr float least_noise = 4.0F;  // a line stands out of the noise by so much
constexpr float least_drop = 0.03F;  // and of the ice by this share of its light
constexpr std::size_t most_sights = 5;
constexpr double full_feature = 8.0;  // sites from which on a feature has its whole say

float sum_of(const std::array<float, 3>& light) { return light[0] + light[1] + light[2]; }

// From where to where along its normal a site's cut stays in the picture, within `reach_px`.
std::pair<double, double> in_picture(const Picture& picture, const PlannedSite& site, double reach_px) {
  double begin = -reach_px;
  double end = reach_px;
  const Eigen::Vector2d size(picture.width_px - 2.0, picture.height_px - 2.0);
  for (int axis = 0; axis < 2; ++axis) {
    const double n = site.normal[axis];
    const double margin = 1.0 + half_breadth * std::abs(site.normal[1 - axis]);
    const double low = margin - site.pixel[axis];
    const double high = size[axis] - margin - site.pixel[axis];
    if (std::abs(n) < 1e-6) {
      if (low > 0.0 || high < 0.0) end = begin - 1.0;
      continue;
    }
    begin = std::max(begin, std::min(low / n, high / n));
    end = std::min(end, std::max(low / n, high / n));
  }
  return {begin, end};
}

}  // namespace

Eigen::Matrix3d head_axes(const Pose& eMc) {
  const Eigen::Vector3d optical = eMc.linear().col(2);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(optical.x(), optical.y(), 0.0).normalized();
  axes.col(2) = Eigen::Vector3d::UnitZ();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// Pan along x, tilt along y.
struct LineVoter::Grid {
  int half_columns, half_rows;
  double step_rad;
  std::vector<float>& votes;

  int columns() const { return 2 * half_columns + 1; }
  void add(double column, double row, float vote) {
    const auto c = static_cast<int>(std::lround(column)) + half_columns;
    const auto r = static_cast<int>(std::lround(row)) + half_rows;
    if (c < 0 || r < 0 || c >= columns() || r > 2 * half_rows) return;
    votes[static_cast<std::size_t>(r * columns() + c)] += vote;
  }
  /// All pans and tilts that move a site by `offset` cells: by_pan * column + by_tilt * row = offset.
  void add_line(double by_pan, double by_tilt, double offset, float vote) {
    if (std::abs(by_pan) > std::abs(by_tilt)) {
      for (int r = -half_rows; r <= half_rows; ++r) add((offset - by_tilt * r) / by_pan, r, vote);
    } else {
      for (int c = -half_columns; c <= half_columns; ++c) add(c, (offset - by_pan * c) / by_tilt, vote);
    }
  }
};

// Places along the site's normal that are darker than both sides, over the line's width.
void LineVoter::look(const PictureLight& light, const PlannedSite& site, double reach_px) {
  sights_.clear();
  const double whole_px = reach_px + 0.5 * site.width_px + side_px + 4.0;
  const auto [begin_px, end_px] = in_picture(light.picture, site, whole_px);
  const int first = static_cast<int>(std::ceil(begin_px));
  cut_.clear();
  constexpr int piece = Profile::max_samples - 2;
  for (int at = first; at <= end_px; at += piece) {
    const Cut cut{site.pixel, site.normal, static_cast<double>(at), std::min(at + piece - 1.0, end_px),
                  1.0,        half_breadth};
    if (!sample(light.picture, light.response, cut, profile_)) break;
    const bool colour = profile_.channels == 3;
    for (std::size_t i = 0; i < static_cast<std::size_t>(profile_.count); ++i) {
      cut_.push_back({profile_.light[0][i], profile_.light[colour ? 1 : 0][i], profile_.light[colour ? 2 : 0][i]});
    }
  }
  const int count = static_cast<int>(cut_.size());
  const int width = std::max(1, static_cast<int>(std::lround(site.width_px)));
  const int span = width + 2 * (gap_px + side_px);
  if (count < span + 3) return;

  const auto mean = [this](int begin, int size, std::size_t k) {
    float sum = 0.0F;
    for (int i = begin; i < begin + size; ++i) sum += cut_[static_cast<std::size_t>(i)][k];
    return sum / static_cast<float>(size);
  };
  drop_.assign(static_cast<std::size_t>(count), 0.0F);
  std::vector<float>& drop = drop_;
  float noise = 0.0F;
  for (int i = 1; i + 1 < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    noise += std::min(0.1F, std::abs(sum_of(cut_[at]) - 0.5F * (sum_of(cut_[at - 1]) + sum_of(cut_[at + 1]))) /
                                std::max(1e-3F, sum_of(cut_[at])));
  }
  noise /= static_cast<float>(count);
  const float least = std::max(least_drop, least_noise * noise / std::sqrt(static_cast<float>(width)));
  for (int i = 0; i + span < count; ++i) {
    float size = 0.0F;
    float sides = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const float before = mean(i, side_px, k);
      const float after = mean(i + span - side_px, side_px, k);
      const float middle = mean(i + side_px + gap_px, width, k);
      size += std::max(0.0F, std::min(before, after) - middle);
      sides += 0.5F * (before + after);
    }
    drop[static_cast<std::size_t>(i)] = size / std::max(1e-3F, sides);
  }
  const double shift = first + 0.5 * (span - 1);
  for (int i = 1; i + 1 < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(drop[at] > least && drop[at] > drop[at - 1] && drop[at] >= drop[at + 1])) continue;
    if (std::abs(i + shift) <= reach_px) sights_.push_back({i + shift, drop[at]});
  }
  std::sort(sights_.begin(), sights_.end(), [](const Sight& a, const Sight& b) { return a.strength > b.strength; });
  if (sights_.size() > most_sights) sights_.resize(most_sights);
}

LineVote LineVoter::find(const PictureLight& light, const Pose& eMc, const std::vector<PlannedSite>& sites,
                         const LineVoteRange& range) {
  std::array<int, paint_feature_count> planned{};
  for (const PlannedSite& site : sites) planned[static_cast<std::size_t>(site.feature)] += site.step ? 0 : 1;

  // A site moves by these when the head turns: the twist's rotation is in c.
  const Eigen::Matrix3d cRh = eMc.linear().transpose() * head_axes(eMc);
  double px_per_rad = 1.0;
  for (const PlannedSite& site : sites) {
    px_per_rad = std::max(px_per_rad, std::abs(site.along.segment<3>(3).dot(cRh.col(1))));
  }
  const double step_rad = cell_px / px_per_rad;
  Grid grid{static_cast<int>(sigmas * range.pan_sigma_rad / step_rad) + 1,
            static_cast<int>(sigmas * range.tilt_sigma_rad / step_rad) + 1, step_rad, votes_};
  votes_.assign(static_cast<std::size_t>(grid.columns() * (2 * grid.half_rows + 1)), 0.0F);

  LineVote vote;
  double features = 0.0;
  for (const int count : planned) features += std::min(1.0, count / full_feature);
  for (const PlannedSite& site : sites) {
    if (site.step) continue;
    const double by_pan = site.along.segment<3>(3).dot(cRh.col(2));
    const double by_tilt = site.along.segment<3>(3).dot(cRh.col(1));
    look(light, site, sigmas * std::hypot(by_pan * range.pan_sigma_rad, by_tilt * range.tilt_sigma_rad));
    if (sights_.empty()) continue;
    ++vote.places;
    const auto say =
        static_cast<float>(1.0 / std::max(full_feature, double{planned[static_cast<std::size_t>(site.feature)] * 1.0}));
    for (const Sight& sight : sights_) {
      const float share = std::sqrt(sight.strength / sights_.front().strength);
      grid.add_line(by_pan * step_rad, by_tilt * step_rad, sight.offset_px, say * share);
    }
  }

  float best = -1.0F;
  for (int r = 1; r < 2 * grid.half_rows; ++r) {
    for (int c = 1; c + 1 < grid.columns(); ++c) {
      float sum = 0.0F;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) sum += votes_[static_cast<std::size_t>((r + i) * grid.columns() + c + j)];
      }
      const double pan = (c - grid.half_columns) * step_rad;
      const double tilt = (r - grid.half_rows) * step_rad;
      const double odds = std::pow(pan / range.pan_sigma_rad, 2) + std::pow(tilt / range.tilt_sigma_rad, 2);
      sum -= static_cast<float>(0.02 * odds);
      if (sum <= best) continue;
      best = sum;
      vote.pan_rad = pan;
      vote.tilt_rad = tilt;
    }
  }
  vote.agreement = features > 0.0 ? static_cast<double>(best) / (3.0 * features) : 0.0;
  return vote;
}

}  // namespace hogline::vision
