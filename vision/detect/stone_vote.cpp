#include "vision/detect/stone_vote.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace hogline::vision {
namespace {

constexpr float first_share = 0.22F;
constexpr float first_handle_share = 0.33F;  // granite on dark paint has hardly an edge
constexpr float faint_share = 0.12F;         // the same, where half a stone is hidden
constexpr float faint_handle_share = 0.16F;
constexpr float big_x_px = 8.0F;  // half axes of a handle's outline that is searched in steps of two pixels
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

/// How many that are not zero. Precondition: the first is not.
int full_run(const std::uint8_t* from, int count) {
  int run = 1;
  while (run < count && from[run] != 0) ++run;
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
  also_faint_ = options.also_faint;
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
  std::size_t count = 0;
  for (const Ballot& ballot : ballots_) {
    const auto taken =
        std::find_if(peaks_.begin(), peaks_.end(), [&](const Ballot& p) { return ballot.removed_by(p); });
    if (taken != peaks_.end()) {
      taken->faint = taken->faint && ballot.faint;
      continue;
    }
    if (count >= most) break;
    peaks_.push_back(best_near(ballot));
    count += peaks_.back().sum < least ? 0 : 1;
  }
  for (const Ballot& peak : peaks_) {
    const Eigen::Vector2d pixel(peak.x, peak.y);
    const auto place = picture.camera.plane_at(pixel, picture.shape.handle_height_m);
    if (!place || peak.sum < least) continue;
    candidates_.push_back({*place, pixel, double{peak.sum}, double{peak.votes.handle}, double{peak.votes.body}});
    candidates_.back().faint = peak.faint;
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
      const int run = full_run(possible + c, std::min(groups.centres.cols, outlines_.next_column(x) / 2) - c);
      c += run - 1;
      const StoneOutline& outline = outlines_.at(x, y);
      if (!outline.seen) continue;
      const int step = outline.half_width_px > big_x_px ? 2 : 1;
      const int rows = outline.half_depth_px > big_y_px ? 1 : 2;
      const int end = x + 2 * run;
      for (int row = y; row < y + rows; ++row) {
        for (int i = x; i < end; i += 4 * step) vote({i, row, step, (end - i + step - 1) / step}, least, outline);
      }
    }
  }
}

void StoneVoter::vote(const Places& places, float least, const StoneOutline& outline) {
  const Asked asked = worth_asking(outline, places);
  if (!asked.any.any()) return;
  const VotesOfFour all = votes_for(outline, places);
  for (int i = 0; i < std::min(4, places.count); ++i) {
    if (!asked.any[i]) continue;
    const Votes votes = all.of(i);
    const float sum = votes.all();
    if (sum > least) ballots_.push_back({places.x + i * places.step, places.y, votes, sum, asked.faint[i], &outline});
  }
}

[[gnu::always_inline]] inline FourPlaces StoneVoter::edges(const Places& places, const OutlineMark& mark) {
  return field_.edges(static_cast<float>(places.x) + mark.x, static_cast<float>(places.y) + mark.y, places.step,
                      mark.normal_x, mark.normal_y);
}

// A few marks on both sides of the body and along the handle's near edge: where hardly any of them stands on an edge
// the rest are not worth asking.
StoneVoter::Asked StoneVoter::worth_asking(const StoneOutline& outline, const Places& places) {
  constexpr auto marks = static_cast<float>(StoneOutline::first_body_marks + StoneOutline::first_handle_marks);
  FourPlaces found = FourPlaces::Zero();
  for (const OutlineMark& m : outline.first_handle) found += edges(places, m);
  constexpr auto handle_marks = static_cast<float>(StoneOutline::first_handle_marks);
  const float handle_share = also_faint_ ? faint_handle_share : first_handle_share;
  const float share = also_faint_ ? faint_share : first_share;
  const OfFour clear_handle = found >= first_handle_share * handle_marks;
  if (clear_handle.all()) return {clear_handle, !clear_handle};
  const OfFour by_handle = found >= handle_share * handle_marks;
  auto left = static_cast<float>(StoneOutline::first_body_marks);
  for (const OutlineMark& m : outline.first_body) {
    if ((found + left < share * marks).all()) return {by_handle, !clear_handle};
    found += edges(places, m);
    left -= 1.0F;
  }
  return {by_handle || found >= share * marks, !(clear_handle || found >= first_share * marks)};
}

StoneVoter::VotesOfFour StoneVoter::votes_for(const StoneOutline& outline, const Places& places) {
  VotesOfFour votes;
  for (const OutlineMark& m : outline.far_rim) votes.handle += edges(places, m);
  for (const auto& marks : outline.near_edge) {
    FourPlaces best = FourPlaces::Zero();
    for (const OutlineMark& m : marks) best = best.max(edges(places, m));
    votes.handle += best;
  }
  for (const OutlineMark& m : outline.body) votes.body += edges(places, m);
  votes.handle /= static_cast<float>(2 * StoneOutline::handle_marks);
  votes.body /= static_cast<float>(StoneOutline::body_marks);
  return votes;
}

StoneVoter::Ballot StoneVoter::best_near(const Ballot& peak) {
  Ballot best = peak;
  for (int y = peak.y - 1; y <= peak.y + 1; ++y) {
    const VotesOfFour row = votes_for(*peak.outline, {peak.x - 1, y, 1, 3});
    for (int i = 0; i < 3; ++i) {
      const Votes votes = row.of(i);
      const float sum = votes.all();
      if (sum > best.sum) best = {peak.x - 1 + i, y, votes, sum, peak.faint, peak.outline};
    }
  }
  return best;
}

}  // namespace hogline::vision
