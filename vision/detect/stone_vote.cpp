#include "vision/detect/stone_vote.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace hogline::vision {
namespace {

constexpr float first_share = 0.22F;
constexpr float first_handle_share = 0.33F;  // granite on dark paint has hardly an edge
constexpr float big_x_px = 8.0F;             // half axes of a handle's outline that is searched in steps of two pixels
constexpr float big_y_px = 4.5F;
constexpr float handle_share = 0.55F;
constexpr float handle_alone = 0.70F;
constexpr float neighbours_may = 0.08F;  // have so many more votes

/// How many zeros follow, counted in eights but for one. Precondition: the first is zero.
int empty_run(const std::uint8_t* from, int count) {
  int run = 1;
  std::uint64_t eight = 0;
  while (run + 8 <= count && (std::memcpy(&eight, from + run, 8), eight == 0)) run += 8;
  return run;
}

}  // namespace

// Of a stone behind others only the handle may be seen.
float StoneVoter::Votes::all() const {
  return std::max(handle_share * handle + (1.0F - handle_share) * body, handle_alone * handle);
}

bool StoneVoter::Ballot::removed_by(const Ballot& peak) const {
  const float dx = static_cast<float>(x - peak.x) / peak.outline->removal_x;
  const float dy = static_cast<float>(y - peak.y) / peak.outline->removal_y;
  return dx * dx + dy * dy <= 1.0F;
}

const std::vector<StoneCandidate>& StoneVoter::find(const StonePicture& picture, const StoneGroups& groups,
                                                    const StoneVoteOptions& options) {
  outlines_.begin(picture.camera, picture.shape, options.area);
  field_.begin(picture.bgr, picture.ice, picture.response);
  const auto least = static_cast<float>(options.least_votes);
  collect(groups, least - neighbours_may);

  sort_ballots();
  take_peaks(picture, least, options.most_candidates);
  return candidates_;
}

void StoneVoter::sort_ballots() {
  std::sort(ballots_.begin(), ballots_.end(), [](const Ballot& a, const Ballot& b) {
    return a.sum != b.sum ? a.sum > b.sum : a.y != b.y ? a.y < b.y : a.x < b.x;
  });
}

void StoneVoter::take_peaks(const StonePicture& picture, float least, std::size_t most) {
  peaks_.clear();
  candidates_.clear();
  for (const Ballot& ballot : ballots_) {
    if (candidates_.size() >= most) break;
    if (std::any_of(peaks_.begin(), peaks_.end(), [&](const Ballot& p) { return ballot.removed_by(p); })) continue;
    const Ballot peak = best_near(ballot);
    peaks_.push_back(peak);
    const Eigen::Vector2d pixel(peak.x, peak.y);
    const auto place = picture.camera.plane_at(pixel, picture.shape.handle_height_m);
    if (!place || peak.sum < least) continue;
    candidates_.push_back({*place, pixel, double{peak.sum}, double{peak.votes.handle}, double{peak.votes.body}});
  }
}

// Every place where a handle may be; where stones are big every second one in both directions.
void StoneVoter::collect(const StoneGroups& groups, float least) {
  ballots_.clear();
  for (int r = 0; r < groups.centres.rows; ++r) {
    const std::uint8_t* possible = groups.centres.ptr<std::uint8_t>(r);
    for (int c = 0; c < groups.centres.cols; ++c) {
      if (possible[c] == 0) {
        c += empty_run(possible + c, groups.centres.cols - c) - 1;
        continue;
      }
      const int x = 2 * c;
      const int y = groups.top + 2 * r;
      const StoneOutline& outline = outlines_.at(x, y);
      if (!outline.seen) continue;
      const int columns = outline.half_width_px > big_x_px ? 1 : 2;
      const int rows = outline.half_depth_px > big_y_px ? 1 : 2;
      for (int i = 0; i < columns * rows; ++i) vote(x + i % columns, y + i / columns, least, outline);
    }
  }
}

void StoneVoter::vote(int x, int y, float least, const StoneOutline& outline) {
  const auto u = static_cast<float>(x);
  const auto v = static_cast<float>(y);
  if (!worth_asking(outline, u, v)) return;
  const Votes votes = votes_for(outline, u, v);
  const float sum = votes.all();
  if (sum > least) ballots_.push_back({x, y, votes, sum, &outline});
}

// A few marks on both sides of the body and along the handle's near edge: where hardly any of them stands on an edge
// the rest are not worth asking.
bool StoneVoter::worth_asking(const StoneOutline& outline, float x, float y) {
  constexpr auto marks = static_cast<float>(StoneOutline::first_body_marks + StoneOutline::first_handle_marks);
  float found = 0.0F;
  for (const OutlineMark& m : outline.first_handle) found += field_.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  if (found >= first_handle_share * static_cast<float>(StoneOutline::first_handle_marks)) return true;
  auto left = static_cast<float>(StoneOutline::first_body_marks);
  for (const OutlineMark& m : outline.first_body) {
    if (found + left < first_share * marks) return false;
    found += field_.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
    left -= 1.0F;
  }
  return found >= first_share * marks;
}

StoneVoter::Votes StoneVoter::votes_for(const StoneOutline& outline, float x, float y) {
  Votes votes;
  for (const OutlineMark& m : outline.far_rim) votes.handle += field_.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  for (const auto& marks : outline.near_edge) {
    float best = 0.0F;
    for (const OutlineMark& m : marks) best = std::max(best, field_.edge(x + m.x, y + m.y, m.normal_x, m.normal_y));
    votes.handle += best;
  }
  for (const OutlineMark& m : outline.body) votes.body += field_.edge(x + m.x, y + m.y, m.normal_x, m.normal_y);
  votes.handle /= static_cast<float>(2 * StoneOutline::handle_marks);
  votes.body /= static_cast<float>(StoneOutline::body_marks);
  return votes;
}

StoneVoter::Ballot StoneVoter::best_near(const Ballot& peak) {
  Ballot best = peak;
  for (int y = peak.y - 1; y <= peak.y + 1; ++y) {
    for (int x = peak.x - 1; x <= peak.x + 1; ++x) {
      const Votes votes = votes_for(*peak.outline, static_cast<float>(x), static_cast<float>(y));
      const float sum = votes.all();
      if (sum > best.sum) best = {x, y, votes, sum, peak.outline};
    }
  }
  return best;
}

}  // namespace hogline::vision
