// The skip's eyes on a throw: every stone on the sheet followed from what the far and near views see, from the release
// to the rest of all that moved (Yoon et al., section III.D, in its two steps: a running stone comes near one that
// stands; that one is looked at anew and found running, or not).
//
// Where the paper decides by a distance, this keeps an account for each thing that may have happened
// (servo/stone_world): passed by, or touched, and how fully. Every account is a physical one, so each knows where its
// stones should be; the looks decide, also when some are missing or somebody stood in the way, and every stone keeps
// its identity.
//
// Looks act at their own stamps, late or out of order; the same looks give the same answer.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "servo/delayed_fusion.hpp"
#include "servo/stone_world.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo {

/// Where a view's camera is, in e, and how well its tilt is known: the error that all its looks share.
struct ViewGeometry {
  double camera_x_m = 0.0;
  double camera_y_m = 0.0;
  double camera_height_m = 0.0;
  double tilt_sigma_rad = 0.0;
};

struct CollisionWatchConfig {
  WorldConfig world;
  std::array<ViewGeometry, view_count> views{};       ///< far, near
  Duration history = std::chrono::milliseconds(400);  ///< how late a look may come
  double doubt = 15.0;                                ///< accounts less likely by this logarithm are dropped
  std::size_t most_accounts = 12;
};

/// What the thrower says when it lets go, in e of the skip.
struct ReleaseSignal {
  Stamp stamp{};
  SlidingStone stone;  ///< with its spin; 0: not known
  double place_sigma_m = 0.0;
  double velocity_sigma_mps = 0.0;
  Team team = Team::unknown;
};

class CollisionWatch {
 public:
  /// `standing`: the stones on the sheet, in e. They get the identities 0, 1, ... in this order; the thrown stone gets
  /// the next. Precondition: finite, covariances positive definite.
  CollisionWatch(const CollisionWatchConfig& config, Stamp start, const std::vector<StoneSighting>& standing);

  /// The thrown stone is born here, or, when it was seen before, is not changed.
  Fusion released(const ReleaseSignal& signal);

  /// A picture's stones. A percept that is not ok changes nothing (`gated`), one older than the history neither.
  Fusion look(const StonesPercept& percept, View view);

  /// The likeliest account, at any moment from the newest look's on.
  World at(Stamp stamp) const;
  /// How many accounts are still believed in, at the newest look.
  std::size_t accounts() const;
  /// A stone was thrown, and nothing moves any more; or it has not been seen for `lost_after`.
  bool over(Stamp now, Duration lost_after = std::chrono::seconds(4)) const;

  const CollisionWatchConfig& config() const { return config_; }

 private:
  struct Picture {
    std::vector<StoneLook> looks;
    std::optional<ReleaseSignal> release;
  };
  struct Model {
    using State = std::vector<World>;
    struct Input {};
    using Measurement = Picture;
    CollisionWatchConfig config;
    void hold(State& worlds, double dt_s) const;
    void drive(State& worlds, double dt_s, const Input&) const { hold(worlds, dt_s); }
    bool correct(State& worlds, const Picture& picture) const;
  };
  Fusion take_in(Stamp stamp, Picture picture);

  CollisionWatchConfig config_;
  DelayedFusion<Model> fusion_;
  Stamp newest_{};
};

}  // namespace hogline::servo
