// Votes for stones' centres (Yoon et al., section III.C, third step): the handle's boundary is a circle of known radius
// at a known height, so that every place has one known outline in the picture, and every edge pixel on it that runs the
// right way is a vote. The body's sides vote too. Peaks are taken one by one, each with what lies within a stone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/detect/edge_field.hpp"
#include "vision/detect/stone_groups.hpp"
#include "vision/detect/stone_outline.hpp"
#include "vision/detect/stone_picture.hpp"

namespace hogline::vision {

struct StoneCandidate {
  Eigen::Vector2d place;  ///< in e, within a pixel of the true one
  Eigen::Vector2d pixel;  ///< of the handle's centre
  double votes = 0.0;     ///< share of the outline, 0..1
  double handle_votes = 0.0;
  double body_votes = 0.0;
  double drift_m = 0.16;  ///< a fit that ends farther from `place` is of something else
  bool faint = false;     ///< so little of the outlines' first marks is there that most of the stone must be hidden
};

struct StoneVoteOptions {
  StoneArea area;
  double least_votes = 0.26;
  bool also_faint = false;
  std::size_t most_candidates = 300;  ///< a dark ring and a crowd make 150, and a stone is not always among the first
};

/// Keeps its memory from picture to picture.
class StoneVoter {
 public:
  /// Candidates of all boxes, by falling votes. They stay until the next call.
  const std::vector<StoneCandidate>& find(const StonePicture& picture, const StoneGroups& groups,
                                          const StoneVoteOptions& options = {});

 private:
  struct Votes {
    float handle = 0.0F;
    float body = 0.0F;
    float all() const;
  };
  /// A place of the picture and its votes.
  struct Ballot {
    int x, y;
    Votes votes;
    float sum;  ///< votes.all()
    bool faint;
    const StoneOutline* outline;
    bool removed_by(const Ballot& peak) const;
  };
  /// Four places of a row, so many pixels apart, of which the first `count` are asked.
  struct Places {
    int x, y;
    int step;
    int count;
  };
  struct VotesOfFour {
    FourPlaces handle = FourPlaces::Zero();
    FourPlaces body = FourPlaces::Zero();
    Votes of(int i) const { return {handle[i], body[i]}; }
  };
  using OfFour = Eigen::Array<bool, 4, 1>;
  /// Which of four places.
  struct Asked {
    OfFour any;    ///< are worth asking
    OfFour faint;  ///< only because much may be hidden
  };

  FourPlaces edges(const Places& places, const OutlineMark& mark);
  Asked worth_asking(const StoneOutline& outline, const Places& places);
  VotesOfFour votes_for(const StoneOutline& outline, const Places& places);
  void vote(const Places& places, float least, const StoneOutline& outline);
  void collect(const StoneGroups& groups, float least);
  void sort_ballots();
  void take_peaks(const StonePicture& picture, float least, std::size_t most);
  Ballot best_near(const Ballot& peak);

  bool also_faint_ = false;
  EdgeField field_;
  OutlineTable outlines_;
  std::vector<Ballot> ballots_;
  std::vector<Ballot> peaks_;
  std::vector<StoneCandidate> candidates_;
};

}  // namespace hogline::vision
