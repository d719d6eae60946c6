// What a sequence of looks at the stones remembers, and the steps of one look.
#pragma once

#include <algorithm>
#include <map>

#include "vision/crowd_screening.hpp"
#include "vision/detect/white_light.hpp"
#include "vision/stone_sequence.hpp"
#include "vision/stone_verdict.hpp"

namespace hogline::vision {

/// A fit that begins anew with what all stones of the last picture shared.
inline StoneFitOptions found_fit(const std::optional<SharedLook>& look) {
  return {.iterations = 3, .pixels = 200, .nearer = {}, .begin_with = look};
}

struct StoneSequence::Impl {
  static constexpr int parts = 8;              ///< of the picture, each searched by itself
  static constexpr double taken_m = 0.2;       ///< no other stone's centre lies so near
  static constexpr double most_reach_m = 0.8;  ///< how far from where it was foretold a stone is looked for

  /// A stone as it was last seen.
  struct Known {
    JudgedStone seen;
    Stamp stamp{};
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    bool in_sight = true;  ///< in the last picture
  };
  /// Where a known stone should be now.
  struct Foretold {
    std::size_t known = 0;
    Eigen::Vector2d place;
    double reach_m = 0.0;  ///< how far from there it may be after all
    bool sure = true;
  };
  /// This picture's stones as far as they are known.
  struct Scene {
    std::vector<JudgedStone> stones;
    std::vector<std::optional<std::size_t>> known;  ///< of each: which one of the last picture's it is
    void add(const JudgedStone& stone, std::optional<std::size_t> which) {
      stones.push_back(stone);
      known.push_back(which);
    }
    bool taken(const Eigen::Vector2d& place) const {
      return std::any_of(stones.begin(), stones.end(), [&](const JudgedStone& s) {
        return s.doubt.empty() && (s.fit.place - place).norm() < taken_m;
      });
    }
    std::vector<KnownStone> believed() const { return vision::believed(stones); }
  };

  explicit Impl(const StonesSetup& given)
      : setup(given), lens(given.camera.intrinsics), response(given.camera.gamma), screening(given.teams) {}

  StoneFinder& finder(const Pose& eMc);
  StonesPercept look(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m,
                     const std::vector<StoneExpectation>& expected);
  StonesPercept look_at_all(const cv::Mat& image, Stamp stamp, const Pose& eMc, std::optional<double> sheet_width_m);

  std::vector<Foretold> foretell(Stamp stamp, const std::vector<StoneExpectation>& expected, const SheetCamera& camera,
                                 std::vector<StoneExpectation>& unknown) const;
  void follow(const StonePicture& picture, const std::vector<Foretold>& foretold, bool in_sight, Scene& scene);
  void search(const StonePicture& picture, StoneGroups& places, const std::vector<Foretold>& missing,
              const std::vector<StoneExpectation>& unknown, const StoneArea& area, Scene& scene);
  void settle(const StonePicture& picture, const std::vector<Foretold>& missing, std::size_t first_new, Scene& scene);
  void follow_closer(const StonePicture& picture, std::vector<JudgedStone>& stones);
  void fit_together(const StonePicture& picture, const StoneFitOptions& options, std::vector<JudgedStone*>& stones);
  const WhiteLight& light(const cv::Mat& image, const Pose& eMc, int top, Stamp stamp);
  StoneGroups unexplained(const StonePicture& picture, StoneGroupFinder& groups, int count, const Scene& scene);
  void leave_out_asked(cv::Mat rows, int first_row, bool all);
  void forget_refused(Stamp stamp);
  StonesPercept report(const StonePicture& picture, const StoneArea& area, Stamp stamp, const Scene& scene) const;
  std::optional<std::size_t> formerly(const JudgedStone& stone, Stamp stamp, const std::vector<bool>& again) const;
  Eigen::Vector2d velocity_of(const Known& before, const Known& now) const;
  void remember(Stamp stamp, const Scene& scene);

  StonesSetup setup;
  Lens lens;
  ResponseCurve response;
  std::map<int, StoneFinder> finders;  ///< by the camera's pitch, in steps
  StoneVoter voter;
  CrowdScreening screening;
  StoneFitter fitter;
  std::optional<SharedLook> shared;  ///< as the last picture showed it
  std::vector<Known> known;
  std::optional<Stamp> last;
  int part = 0;   ///< whose turn it is
  int round = 0;  ///< how often all had it
  cv::Mat asked;  ///< of half the picture's size: where unexplained granite was asked about
  struct Refused {
    Eigen::Vector2d place;
    Stamp stamp{};
  };
  std::vector<Refused> refused;
  struct Lit {
    WhiteLight light;
    Pose eMc;
    Stamp stamp{};
    int top;
  };
  std::optional<Lit> lit;
  StoneSequenceDiagnosis diagnosis;
};

}  // namespace hogline::vision
