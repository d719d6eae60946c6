// Simulated throws as the skip sees them: stones on the sheet, one thrown, two views with noise, dropouts, people in
// the way, false looks and delays. Frame e of the skip.
#pragma once

#include <cstdint>
#include <vector>

#include "servo/collision_watch.hpp"
#include "servo/throw_result.hpp"
#include "tests/servo/throw_plant.hpp"

namespace hogline::servo::test {

/// What stands between the skip and the stones.
struct Disturbance {
  double dropout = 0.05;         ///< share of looks at a stone that fail
  double clutter = 0.02;         ///< false looks a picture
  double latency_s = 0.03;       ///< of a picture,
  double jitter_s = 0.02;        ///< up to this much more
  double hidden_s = 2.0;         ///< so long nobody sees the thrown stone, nor what is near it,
  std::vector<double> hidden{};  ///< from these times after the release on
};

struct Scene {
  std::vector<PlantStone> standing;
  SlidingStone thrown;  ///< at the release
  IceFactors ice;
  double restitution = 0.9;
  double friction = 0.1;
};

enum class SceneKind { draw, guard, hit, double_hit, through, hogged, sideline };

/// A throw of that kind, all else at random: places, weight, turn, ice.
Scene scene_of(SceneKind kind, std::mt19937_64& random);

struct Picture {
  Stamp arrives{};
  View view = View::near;
  StonesPercept percept;
};

struct TruePlace {
  Stamp stamp{};
  std::vector<SlidingStone> stones;
};

/// The scene played to rest.
struct Played {
  std::vector<Picture> pictures;  ///< as they arrive
  std::vector<TruePlace> truth;   ///< at each picture's stamp, in order
  std::vector<PlantContact> contacts;
  std::vector<StoneFate> fates;
  std::vector<double> margins_m;  ///< by how much each fate is what it is
  Stamp released{};
  Stamp end{};
};
Played play(const Scene& scene, const Disturbance& disturbance, std::mt19937_64& random);

/// Ice known to 1 % of friction and 5 % of curl, with an error of that size.
IceEstimate about(const IceFactors& ice, std::mt19937_64& random);
CollisionWatchConfig watch_config(const IceEstimate& ice);
std::vector<StoneSighting> seen_standing(const Scene& scene, std::mt19937_64& random);
ReleaseSignal signal_of(const Scene& scene);

}  // namespace hogline::servo::test
