#include "vision/detect/stone_vote.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr int block_px = 16;
constexpr float full_vote = 0.22F;  // gradient, all channels, of a step of about half the light of ice
constexpr float noise_floor = 0.05F;
constexpr double removal_m = 0.23;  // stones stand 0.29 m apart; votes are good to a pixel
constexpr double handle_share = 0.55;

/// A place of an outline relative to the handle's centre, with the outline's normal there.
struct Mark {
  float x, y, normal_x, normal_y;
};

/// The outline of a stone in one part of the picture. The handle's near edge lies lower by its thickness, which is only
/// roughly known: one mark each for a thin, a middling and a thick one, the best counts.
struct Outline {
  bool seen = false;
  std::vector<Mark> far_rim;
  std::vector<std::array<Mark, 3>> near_edge;
  std::vector<Mark> body;
  float removal_x = 0.0F;
  float removal_y = 0.0F;
};

class OutlineMaker {
 public:
  OutlineMaker(const SheetCamera& camera, const StoneShape& shape, const StoneArea& area)
      : camera_(camera), shape_(shape), area_(area) {}

  Outline at(const Eigen::Vector2d& pixel) const {
    Outline outline;
    const auto place = camera_.plane_at(pixel, shape_.handle_height_m);
    if (!place || !area_.contains(*place)) return outline;
    const Eigen::Vector3d eye = camera_.eMc().translation();
    const Bearing bearing = bearing_of(*place, eye);
    if (bearing.range_m < 2.0 * shape_.body_radius_m) return outline;
    const auto circle = [&](double height_m) {
      return [&, height_m](double a) {
        return camera_.project(circle_point(*place, bearing, shape_.handle_radius_m, height_m, a));
      };
    };
    const auto body = [&](double a) { return camera_.project(body_outline_point(*place, shape_, eye, a)); };
    outline.seen = true;
    constexpr double pi = std::numbers::pi;
    for (int i = 0; i < 11; ++i) {
      add(circle(shape_.handle_height_m), pixel, pi * (0.08 + 0.084 * i), outline.far_rim);
    }
    for (int i = 0; i < 11; ++i) {
      std::vector<Mark> marks;
      for (const double thick : {0.5, 1.0, 1.6}) {
        add(circle(shape_.handle_height_m - thick * shape_.handle_thickness_m), pixel, -pi * (0.08 + 0.084 * i), marks);
      }
      if (marks.size() == 3) outline.near_edge.push_back({marks[0], marks[1], marks[2]});
    }
    for (int i = 0; i < 8; ++i) {
      const double a = -0.9 + 0.2 * i;  // from below the waist to the shoulder
      add(body, pixel, a, outline.body);
      add(body, pixel, pi - a, outline.body);
    }
    for (int i = 0; i < 5; ++i) add(body, pixel, -0.5 * pi + 0.25 * (i - 2), outline.body);
    const auto right = camera_.project(circle_point(*place, bearing, removal_m, shape_.handle_height_m, 0.0));
    const auto away = camera_.project(circle_point(*place, bearing, removal_m, shape_.handle_height_m, 0.5 * pi));
    if (!right || !away) return Outline{};
    outline.removal_x = static_cast<float>((*right - pixel).norm());
    outline.removal_y = std::max(2.0F, static_cast<float>((*away - pixel).norm()));
    return outline;
  }

 private:
  template <typename Curve>
  void add(const Curve& curve, const Eigen::Vector2d& centre, double a, std::vector<Mark>& marks) const {
    const auto p = curve(a);
    const auto next = curve(a + 0.02);
    if (!p || !next) return;
    const Eigen::Vector2d along = (*next - *p).normalized();
    if (!along.allFinite()) return;
    marks.push_back({static_cast<float>(p->x() - centre.x()), static_cast<float>(p->y() - centre.y()),
                     static_cast<float>(-along.y()), static_cast<float>(along.x())});
  }

  const SheetCamera& camera_;
  StoneShape shape_;
  StoneArea area_;
};

struct Votes {
  float handle = 0.0F;
  float body = 0.0F;
  float all() const {
    return static_cast<float>(handle_share) * handle + static_cast<float>(1.0 - handle_share) * body;
  }
};

Votes votes_for(const EdgeField& field, const Outline& outline, float x, float y) {
  Votes votes;
  for (const Mark& m : outline.far_rim) votes.handle += field.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  for (const auto& marks : outline.near_edge) {
    float best = 0.0F;
    for (const Mark& m : marks) best = std::max(best, field.edge(x + m.x, y + m.y, m.normal_x, m.normal_y));
    votes.handle += best;
  }
  for (const Mark& m : outline.body) votes.body += field.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  votes.handle /= static_cast<float>(std::max<std::size_t>(1, outline.far_rim.size() + outline.near_edge.size()));
  votes.body /= static_cast<float>(std::max<std::size_t>(1, outline.body.size()));
  return votes;
}

/// The votes of one box.
class Accumulator {
 public:
  Accumulator(const EdgeField& field, const StoneGroups& groups, const OutlineMaker& maker) : area_(field.area()) {
    votes_.resize(static_cast<std::size_t>(area_.area()));
    for (int y = area_.y; y < area_.br().y; ++y) {
      const int row = (y - groups.top) / 2;
      if (y < groups.top || row >= groups.centres.rows) continue;
      const std::uint8_t* possible = groups.centres.ptr<std::uint8_t>(row);
      for (int x = area_.x; x < area_.br().x; ++x) {
        if (possible[std::min(x / 2, groups.centres.cols - 1)] == 0) continue;
        const Outline& outline = outline_at(x, y, maker);
        if (outline.seen) at(x, y) = votes_for(field, outline, static_cast<float>(x), static_cast<float>(y));
      }
    }
  }

  void take_peaks(const SheetCamera& camera, const StoneShape& shape, const OutlineMaker& maker, double least,
                  std::vector<StoneCandidate>& candidates) {
    while (true) {
      int best_x = 0;
      int best_y = 0;
      float best = static_cast<float>(least);
      for (int y = area_.y; y < area_.br().y; ++y) {
        for (int x = area_.x; x < area_.br().x; ++x) {
          if (at(x, y).all() <= best) continue;
          best = at(x, y).all();
          best_x = x;
          best_y = y;
        }
      }
      if (!(best > static_cast<float>(least))) return;
      const Eigen::Vector2d pixel(best_x, best_y);
      const Votes& votes = at(best_x, best_y);
      if (const auto place = camera.plane_at(pixel, shape.handle_height_m)) {
        candidates.push_back({*place, pixel, votes.all(), votes.handle, votes.body});
      }
      remove_around(best_x, best_y, outline_at(best_x, best_y, maker));
    }
  }

 private:
  Votes& at(int x, int y) { return votes_[static_cast<std::size_t>((y - area_.y) * area_.width + x - area_.x)]; }

  const Outline& outline_at(int x, int y, const OutlineMaker& maker) {
    const int key = (y / block_px) * 4096 + x / block_px;
    const auto known = outlines_.find(key);
    if (known != outlines_.end()) return known->second;
    const Eigen::Vector2d middle((x / block_px + 0.5) * block_px, (y / block_px + 0.5) * block_px);
    return outlines_.emplace(key, maker.at(middle)).first->second;
  }

  void remove_around(int x, int y, const Outline& outline) {
    const auto wide = static_cast<int>(outline.removal_x);
    const auto high = static_cast<int>(outline.removal_y);
    for (int v = std::max(area_.y, y - high); v <= std::min(area_.br().y - 1, y + high); ++v) {
      for (int u = std::max(area_.x, x - wide); u <= std::min(area_.br().x - 1, x + wide); ++u) {
        const float dx = static_cast<float>(u - x) / outline.removal_x;
        const float dy = static_cast<float>(v - y) / outline.removal_y;
        if (dx * dx + dy * dy <= 1.0F) at(u, v) = {};
      }
    }
  }

  cv::Rect area_;
  std::vector<Votes> votes_;
  std::map<int, Outline> outlines_;
};

}  // namespace

EdgeField::EdgeField(const cv::Mat& bgr, const cv::Rect& area, const IceLight& ice, const ResponseCurve& response)
    : area_(area), gradient_(static_cast<std::size_t>(area.area())) {
  // One level of light per channel for the whole box: against it every level's square root is tabulated.
  const auto white = ice.at(area.x + 0.5 * area.width, area.y + 0.5 * area.height);
  std::array<std::array<float, 256>, 3> root{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 256; ++i) {
      root[k][i] = std::sqrt(std::min(1.5F, response.linear(static_cast<std::uint8_t>(i)) / white[k]));
    }
  }
  // Binomial over three rows, then differences over three columns, and the other way round.
  const auto n = static_cast<std::size_t>(area.width);
  std::array<std::vector<float>, 3> rows;
  for (auto& row : rows) row.resize(3 * n);
  const auto load = [&](int y, std::vector<float>& row) {
    const std::uint8_t* in = bgr.ptr<std::uint8_t>(std::clamp(y, 0, bgr.rows - 1)) + 3 * area.x;
    for (std::size_t i = 0; i < 3 * n; ++i) row[i] = root[i % 3][in[i]];
  };
  load(area.y - 1, rows[0]);
  load(area.y, rows[1]);
  for (int y = 0; y < area.height; ++y) {
    const std::vector<float>& a = rows[static_cast<std::size_t>(y % 3)];
    const std::vector<float>& b = rows[static_cast<std::size_t>((y + 1) % 3)];
    std::vector<float>& c = rows[static_cast<std::size_t>((y + 2) % 3)];
    load(area.y + y + 1, c);
    for (std::size_t x = 1; x + 1 < n; ++x) {
      Gradient& g = gradient_[static_cast<std::size_t>(y) * n + x];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = 3 * x + k;
        const auto smooth = [&](std::size_t j) { return a[j] + 2.0F * b[j] + c[j]; };
        g.x[k] = 0.125F * (smooth(i + 3) - smooth(i - 3));
        g.y[k] = 0.125F * (c[i - 3] + 2.0F * c[i] + c[i + 3] - a[i - 3] - 2.0F * a[i] - a[i + 3]);
      }
    }
  }
}

float EdgeField::edge(float x, float y, float normal_x, float normal_y) const {
  const int column = static_cast<int>(std::lround(x)) - area_.x;
  const int row = static_cast<int>(std::lround(y)) - area_.y;
  if (column < 0 || row < 0 || column >= area_.width || row >= area_.height) return 0.0F;
  const Gradient& g = gradient_[static_cast<std::size_t>(row * area_.width + column)];
  float across = 0.0F;
  float along = 0.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    across += std::abs(g.x[k] * normal_x + g.y[k] * normal_y);
    along += std::abs(g.y[k] * normal_x - g.x[k] * normal_y);
  }
  return std::clamp((across - 0.5F * along - noise_floor) / full_vote, 0.0F, 1.0F);
}

std::vector<StoneCandidate> vote_for_stones(const cv::Mat& bgr, const StoneGroups& groups, const IceLight& ice,
                                            const ResponseCurve& response, const SheetCamera& camera,
                                            const StoneShape& shape, const StoneVoteOptions& options) {
  std::vector<StoneCandidate> candidates;
  const OutlineMaker maker(camera, shape, options.area);
  for (const cv::Rect& box : groups.boxes) {
    const EdgeField field(bgr, box, ice, response);
    Accumulator votes(field, groups, maker);
    votes.take_peaks(camera, shape, maker, options.least_votes, candidates);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const StoneCandidate& a, const StoneCandidate& b) { return a.votes > b.votes; });
  if (candidates.size() > options.most_candidates) candidates.resize(options.most_candidates);
  return candidates;
}

}  // namespace hogline::vision
