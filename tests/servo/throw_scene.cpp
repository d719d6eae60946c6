#include "tests/servo/throw_scene.hpp"

#include <algorithm>
#include <cmath>

#include "servo/skip_sheet.hpp"
#include "servo/stone_path.hpp"

namespace hogline::servo::test {

namespace {

constexpr double release_y_m = 29.2;
constexpr double sheet_width_m = 4.75;
constexpr int steps_per_picture = 33;

double between(double a, double b, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(a, b)(random);
}

PlantStone at_rest(double x_m, double y_m, Team team) {
  PlantStone stone;
  stone.motion.x_m = x_m, stone.motion.y_m = y_m;
  stone.team = team;
  return stone;
}

SlidingStone released(double speed, double heading, double spin) {
  return {0.0, release_y_m, speed * std::sin(heading), -speed * std::cos(heading), spin};
}

/// Heading with which a stone of this weight has this x where it crosses y.
SlidingStone aimed_over(double x_m, double y_m, double speed, double spin, const IceFactors& ice) {
  double heading = 0.0;
  for (int i = 0; i < 20; ++i) {
    const StonePath path(released(speed, heading, spin), ice);
    const auto there = path.crossing_s(y_m);
    const double x = there ? path.at(*there).stone.x_m : path.rest().x_m;
    heading += (x_m - x) / (release_y_m - y_m);
  }
  return released(speed, heading, spin);
}

/// Weight with which a stone rests at this y.
double weight_for(double y_m, double spin, const IceFactors& ice) {
  double low = 0.5, high = 4.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (rest_of(released(middle, 0.0, spin), ice).y_m > y_m ? low : high) = middle;
  }
  return high;
}

bool clear_of(const std::vector<PlantStone>& stones, double x, double y, double gap_m) {
  return std::all_of(stones.begin(), stones.end(),
                     [&](const PlantStone& s) { return std::hypot(s.motion.x_m - x, s.motion.y_m - y) > gap_m; });
}

void add_bystanders(Scene& scene, int count, std::mt19937_64& random) {
  for (int tries = 0; count > 0 && tries < 500; ++tries) {
    const double x = between(-1.8, 1.8, random), y = between(-1.5, 5.5, random);
    if (!clear_of(scene.standing, x, y, 0.4)) continue;
    scene.standing.push_back(at_rest(x, y, between(0, 1, random) < 0.5 ? Team::first : Team::second));
    --count;
  }
}

/// A target, and behind it on the line it will take a second one.
void add_targets(Scene& scene, bool two, double spin, std::mt19937_64& random) {
  const double x = between(-0.8, 0.8, random), y = between(-0.5, 3.0, random);
  const double aside = between(-0.2, 0.2, random);
  scene.standing.push_back(at_rest(x, y, Team::second));
  const double speed = weight_for(between(-14.0, -4.0, random), spin, scene.ice);
  scene.thrown = aimed_over(x + aside, y + 0.25, speed, spin, scene.ice);
  if (!two) return;
  const double angle = std::asin(std::clamp(-aside / 0.29, -1.0, 1.0)) * 0.9;
  const double away = between(0.45, 1.2, random), off = between(-0.12, 0.12, random);
  scene.standing.push_back(at_rest(x + away * std::sin(angle) + off * std::cos(angle),
                                   y - away * std::cos(angle) + off * std::sin(angle), Team::first));
}

}  // namespace

Scene scene_of(SceneKind kind, std::mt19937_64& random) {
  Scene scene;
  scene.ice = {between(0.85, 1.2, random), between(0.6, 1.1, random), between(-3e-4, 3e-4, random)};
  scene.restitution = between(0.8, 0.95, random);
  scene.friction = between(0.05, 0.2, random);
  const double spin = between(0, 1, random) < 0.5 ? 1.57 : -1.57;
  const auto to_rest_at = [&](double x, double y) {
    scene.thrown = aimed_over(x, y + 0.01, weight_for(y, spin, scene.ice), spin, scene.ice);
  };
  switch (kind) {
    case SceneKind::draw:
      to_rest_at(between(-1.0, 1.0, random), between(-1.2, 1.5, random));
      break;
    case SceneKind::guard:
      to_rest_at(between(-1.0, 1.0, random), between(2.2, 5.5, random));
      break;
    case SceneKind::hit:
    case SceneKind::double_hit:
      add_targets(scene, kind == SceneKind::double_hit, spin, random);
      break;
    case SceneKind::through:
      scene.thrown = aimed_over(between(-1.0, 1.0, random), 0.0,
                                weight_for(between(-5.0, -3.0, random), spin, scene.ice), spin, scene.ice);
      break;
    case SceneKind::hogged:
      to_rest_at(between(-1.0, 1.0, random), between(6.7, 9.0, random));
      break;
    case SceneKind::sideline:
      scene.thrown = aimed_over((spin > 0 ? 1.0 : -1.0) * 2.6, between(2.0, 6.0, random),
                                weight_for(-3.0, spin, scene.ice), spin, scene.ice);
      break;
  }
  add_bystanders(scene, static_cast<int>(between(0.0, 5.0, random)), random);
  return scene;
}

namespace {

StoneSighting sighting(const TrackLook& look, Team team, double handle) {
  StoneSighting seen;
  seen.x_m = look.x_m, seen.y_m = look.y_m;
  seen.covariance = look.covariance;
  seen.team = team;
  seen.team_confidence = 0.9;
  seen.handle_rad = handle;
  return seen;
}

bool in_view(double y_m, View view) { return view == View::far ? y_m > hog_line_m && y_m < 28.5 : y_m < 7.0; }

bool is_hidden(const SlidingStone& stone, const SlidingStone& thrown, double after_s, const Disturbance& d) {
  const bool near = std::hypot(stone.x_m - thrown.x_m, stone.y_m - thrown.y_m) < 0.8;
  return near && std::any_of(d.hidden.begin(), d.hidden.end(),
                             [&](double from) { return after_s >= from && after_s < from + d.hidden_s; });
}

Picture picture(const ThrowPlant& plant, const PlantView& view, double tilt, const Disturbance& d,
                std::mt19937_64& random) {
  Picture p;
  p.view = view.view;
  p.percept.ok = true;
  p.percept.stamp = plant.now();
  p.arrives = plant.now() + from_seconds(d.latency_s + between(0.0, d.jitter_s, random));
  const hw::sim::StoneTruth& t = plant.stones().back().motion;
  const SlidingStone thrown{t.x_m, t.y_m, 0, 0, 0};
  std::normal_distribution<double> normal;
  for (const PlantStone& stone : plant.stones()) {
    const hw::sim::StoneTruth& s = stone.motion;
    if (!in_view(s.y_m, view.view) || between(0, 1, random) < d.dropout) continue;
    if (is_hidden({s.x_m, s.y_m, 0, 0, 0}, thrown, seconds(plant.now() - throw_start), d)) continue;
    const TrackLook look = look_at(s.x_m, s.y_m, plant.now(), view, tilt, random);
    p.percept.stones.push_back(
        sighting(look, stone.team, std::remainder(s.handle_rad + 0.05 * normal(random), 3.14159265)));
  }
  if (between(0, 1, random) < d.clutter) {
    const double y = view.view == View::far ? between(7.0, 25.0, random) : between(-2.0, 6.0, random);
    const TrackLook look = look_at(between(-2.0, 2.0, random), y, plant.now(), view, 0.0, random);
    p.percept.stones.push_back(sighting(look, Team::unknown, 0.0));
  }
  std::shuffle(p.percept.stones.begin(), p.percept.stones.end(), random);
  return p;
}

/// What the rules make of the way of one stone.
void judge(Played& played, std::size_t i, bool thrown) {
  double side = 1e9, back = 1e9;
  for (const TruePlace& at : played.truth) {
    if (back < 0.0 || side < 0.0) break;
    side = std::min(side, 0.5 * sheet_width_m - std::abs(at.stones[i].x_m) - 0.145);
    back = std::min(back, at.stones[i].y_m + 0.145 + 1.829);
  }
  const double hog = 6.401 - 0.145 - played.truth.back().stones[i].y_m;
  const auto hits = [&](const PlantContact& c) {
    return c.striker == static_cast<int>(i) || c.struck == static_cast<int>(i);
  };
  const bool short_of_it = thrown && std::none_of(played.contacts.begin(), played.contacts.end(), hits);
  StoneFate fate = StoneFate::at_rest;
  if (short_of_it && hog < 0.0) fate = StoneFate::hogged;
  if (back < 0.0) fate = StoneFate::through;
  if (side < 0.0) fate = StoneFate::sideline;
  double margin = std::min(std::abs(side), std::abs(back));
  if (short_of_it && fate != StoneFate::sideline && fate != StoneFate::through)
    margin = std::min(margin, std::abs(hog));
  // A stone that is out goes on being so: in doubt is only by which line it left, over a corner.
  if (fate == StoneFate::sideline) margin = std::max(0.0, back);
  if (fate == StoneFate::through) margin = std::max(0.0, side);
  played.fates.push_back(fate);
  played.margins_m.push_back(margin);
}

}  // namespace

Played play(const Scene& scene, const Disturbance& d, std::mt19937_64& random) {
  std::vector<PlantStone> stones = scene.standing;
  PlantStone thrown;
  thrown.motion = {scene.thrown.x_m,    scene.thrown.y_m,        scene.thrown.vx_mps,
                   scene.thrown.vy_mps, scene.thrown.spin_radps, 0.3};
  stones.push_back(thrown);
  ThrowPlant plant(stones, scene.ice, scene.restitution, scene.friction);
  std::normal_distribution<double> normal;
  const PlantView far = far_view(), near = near_view();
  const double far_tilt = far.tilt_sigma_rad * normal(random), near_tilt = near.tilt_sigma_rad * normal(random);
  Played played;
  double seen_again_s = 0.0;
  for (const double from : d.hidden) seen_again_s = std::max(seen_again_s, from + d.hidden_s);
  int resting = 0;
  for (int i = 1; resting < 1500 && i < 60000; ++i) {
    plant.step();
    resting += plant.all_rest() && i * step_s > seen_again_s;
    if (i % steps_per_picture != 0) continue;
    TruePlace truth{plant.now(), {}};
    for (const PlantStone& s : plant.stones()) {
      truth.stones.push_back({s.motion.x_m, s.motion.y_m, s.motion.vx_mps, s.motion.vy_mps, s.motion.spin_radps});
    }
    played.truth.push_back(truth);
    played.pictures.push_back(picture(plant, far, far_tilt, d, random));
    played.pictures.push_back(picture(plant, near, near_tilt, d, random));
  }
  std::stable_sort(played.pictures.begin(), played.pictures.end(),
                   [](const Picture& a, const Picture& b) { return a.arrives < b.arrives; });
  played.contacts = plant.contacts();
  played.released = throw_start;
  played.end = plant.now();
  for (std::size_t i = 0; i < plant.stones().size(); ++i) judge(played, i, i + 1 == plant.stones().size());
  return played;
}

IceEstimate about(const IceFactors& ice, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  IceEstimate estimate;
  estimate.friction_scale = ice.friction_scale + 0.01 * normal(random);
  estimate.curl_gain = ice.curl_gain + 0.05 * normal(random);
  estimate.lateral_mps2 = ice.lateral_mps2 + 5e-5 * normal(random);
  estimate.covariance = {1e-4, 0, 0, 0, 2.5e-3, 0, 0, 0, 2.5e-9};
  estimate.throws = 2;
  return estimate;
}

CollisionWatchConfig watch_config(const IceEstimate& ice) {
  CollisionWatchConfig config;
  config.world.ice = ice;
  config.world.sheet_width_m = sheet_width_m;
  const PlantView far = far_view(), near = near_view();
  config.views[0] = {far.camera_x_m, far.camera_y_m, far.camera_height_m, far.tilt_sigma_rad};
  config.views[1] = {near.camera_x_m, near.camera_y_m, near.camera_height_m, near.tilt_sigma_rad};
  return config;
}

std::vector<StoneSighting> seen_standing(const Scene& scene, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<StoneSighting> seen;
  for (const PlantStone& stone : scene.standing) {
    TrackLook look;
    look.x_m = stone.motion.x_m + 0.006 * normal(random);
    look.y_m = stone.motion.y_m + 0.006 * normal(random);
    look.covariance = {3.6e-5, 0.0, 3.6e-5};
    seen.push_back(sighting(look, stone.team, 0.0));
  }
  return seen;
}

ReleaseSignal signal_of(const Scene& scene) {
  ReleaseSignal signal{throw_start, scene.thrown, 0.05, 0.05, Team::first};
  return signal;
}

}  // namespace hogline::servo::test
