#include "vision/detect/stone_vote.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "vision/detect/edge_field.hpp"

namespace hogline::vision {
namespace {

constexpr int block_px = 24;
constexpr float first_share = 0.22F;
constexpr float big_x_px = 12.0F;  // half axes of a handle's outline that is searched in steps of two pixels
constexpr float big_y_px = 6.0F;
constexpr double removal_m =
    0.14;  // the fit parts what stands nearer than a stone; a wrong peak must not take a stone along
constexpr double handle_share = 0.55;
constexpr double handle_alone = 0.70;

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
  std::vector<Mark> first_marks;  ///< some of these
  bool big_x = false;
  bool big_y = false;
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
    for (int i = 0; i < 8; ++i) {
      add(circle(shape_.handle_height_m), pixel, pi * (0.08 + 0.12 * i), outline.far_rim);
    }
    for (int i = 0; i < 8; ++i) {
      std::vector<Mark> marks;
      for (const double thick : {0.5, 1.0, 1.6}) {
        add(circle(shape_.handle_height_m - thick * shape_.handle_thickness_m), pixel, -pi * (0.08 + 0.12 * i), marks);
      }
      if (marks.size() == 3) outline.near_edge.push_back({marks[0], marks[1], marks[2]});
    }
    for (int i = 0; i < 5; ++i) {
      const double a = -0.9 + 0.35 * i;  // from below the waist to the shoulder
      add(body, pixel, a, outline.body);
      add(body, pixel, pi - a, outline.body);
    }
    for (int i = 0; i < 3; ++i) add(body, pixel, -0.5 * pi + 0.4 * (i - 1), outline.body);
    for (std::size_t i = 0; i < outline.body.size(); i += 3) outline.first_marks.push_back(outline.body[i]);
    for (std::size_t i = 1; i < outline.near_edge.size(); i += 3)
      outline.first_marks.push_back(outline.near_edge[i][1]);
    for (std::size_t i = 1; i < outline.far_rim.size(); i += 3) outline.first_marks.push_back(outline.far_rim[i]);
    const auto right = camera_.project(circle_point(*place, bearing, removal_m, shape_.handle_height_m, 0.0));
    const auto away = camera_.project(circle_point(*place, bearing, removal_m, shape_.handle_height_m, 0.5 * pi));
    if (!right || !away) return Outline{};
    outline.removal_x = static_cast<float>((*right - pixel).norm());
    outline.removal_y = std::max(2.0F, static_cast<float>((*away - pixel).norm()));
    const auto part = static_cast<float>(shape_.handle_radius_m / removal_m);
    outline.big_x = part * outline.removal_x > big_x_px;
    outline.big_y = part * outline.removal_y > big_y_px;
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
  // Of a stone behind others only the handle may be seen.
  float all() const {
    return std::max(static_cast<float>(handle_share) * handle + static_cast<float>(1.0 - handle_share) * body,
                    static_cast<float>(handle_alone) * handle);
  }
};

// A few marks on both sides of the body and along the handle's near edge: where hardly any of them stands on an edge
// the rest are not worth asking.
bool worth_asking(EdgeField& field, const Outline& outline, float x, float y) {
  float sum = 0.0F;
  for (const Mark& m : outline.first_marks) sum += field.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  return sum >= first_share * static_cast<float>(outline.first_marks.size());
}

Votes votes_for(EdgeField& field, const Outline& outline, float x, float y) {
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

/// A place of the picture and its votes.
struct Ballot {
  int x, y;
  Votes votes;
  const Outline* outline;
};

/// Outlines change slowly over the picture: one for each block, made when it is first asked for.
class OutlineTable {
 public:
  OutlineTable(const OutlineMaker& maker, cv::Size picture)
      : maker_(maker),
        columns_(picture.width / block_px + 1),
        outlines_(static_cast<std::size_t>(columns_ * (picture.height / block_px + 1))) {}

  const Outline& at(int x, int y) {
    auto& outline = outlines_[static_cast<std::size_t>(y / block_px * columns_ + x / block_px)];
    if (!outline) {
      outline =
          std::make_unique<Outline>(maker_.at({(x / block_px + 0.5) * block_px, (y / block_px + 0.5) * block_px}));
    }
    return *outline;
  }

 private:
  const OutlineMaker& maker_;
  int columns_;
  std::vector<std::unique_ptr<Outline>> outlines_;
};

// Every place where a handle may be; where stones are big every second one in both directions.
std::vector<Ballot> all_ballots(const StoneGroups& groups, EdgeField& field, OutlineTable& outlines, float least) {
  std::vector<Ballot> ballots;
  for (int r = 0; r < groups.centres.rows; ++r) {
    const std::uint8_t* possible = groups.centres.ptr<std::uint8_t>(r);
    for (int c = 0; c < groups.centres.cols; ++c) {
      if (possible[c] == 0) continue;
      const Outline& outline = outlines.at(2 * c, groups.top + 2 * r);
      if (!outline.seen) continue;
      for (int y = groups.top + 2 * r; y < groups.top + 2 * r + (outline.big_y ? 1 : 2); ++y) {
        for (int x = 2 * c; x < 2 * c + (outline.big_x ? 1 : 2); ++x) {
          if (!worth_asking(field, outline, static_cast<float>(x), static_cast<float>(y))) continue;
          const Votes votes = votes_for(field, outline, static_cast<float>(x), static_cast<float>(y));
          if (votes.all() > least) ballots.push_back({x, y, votes, &outline});
        }
      }
    }
  }
  std::sort(ballots.begin(), ballots.end(),
            [](const Ballot& a, const Ballot& b) { return a.votes.all() > b.votes.all(); });
  return ballots;
}

Ballot best_near(const Ballot& peak, EdgeField& field) {
  Ballot best = peak;
  for (int y = peak.y - 1; y <= peak.y + 1; ++y) {
    for (int x = peak.x - 1; x <= peak.x + 1; ++x) {
      const Votes votes = votes_for(field, *peak.outline, static_cast<float>(x), static_cast<float>(y));
      if (votes.all() > best.votes.all()) best = {x, y, votes, peak.outline};
    }
  }
  return best;
}

bool removed_by(const Ballot& peak, const Ballot& other) {
  const float dx = static_cast<float>(other.x - peak.x) / peak.outline->removal_x;
  const float dy = static_cast<float>(other.y - peak.y) / peak.outline->removal_y;
  return dx * dx + dy * dy <= 1.0F;
}

}  // namespace

std::vector<StoneCandidate> vote_for_stones(const StonePicture& picture, const StoneGroups& groups,
                                            const StoneVoteOptions& options) {
  const OutlineMaker maker(picture.camera, picture.shape, options.area);
  OutlineTable outlines(maker, picture.bgr.size());
  EdgeField field(picture.bgr, picture.ice, picture.response);
  const float floor = static_cast<float>(options.least_votes) - 0.08F;  // a neighbouring pixel may have more

  std::vector<Ballot> peaks;
  std::vector<StoneCandidate> candidates;
  for (const Ballot& ballot : all_ballots(groups, field, outlines, floor)) {
    if (candidates.size() >= options.most_candidates) break;
    if (std::any_of(peaks.begin(), peaks.end(), [&](const Ballot& p) { return removed_by(p, ballot); })) continue;
    const Ballot peak = best_near(ballot, field);
    peaks.push_back(peak);
    const Eigen::Vector2d pixel(peak.x, peak.y);
    const auto place = picture.camera.plane_at(pixel, picture.shape.handle_height_m);
    if (!place || peak.votes.all() < static_cast<float>(options.least_votes)) continue;
    candidates.push_back({*place, pixel, peak.votes.all(), peak.votes.handle, peak.votes.body});
  }
  return candidates;
}

}  // namespace hogline::vision
