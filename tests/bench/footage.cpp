#include "tests/bench/footage.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "tests/support/run_sequence.hpp"
#include "tests/support/turning_sequence.hpp"
#include "tests/vision/scene.hpp"

namespace hogline::bench {
namespace {

constexpr int looks_at_a_scene = 5;
constexpr int looks_before_counting = 2;

Footage standing_still(const vision::testing::Scene& scene, const std::string& name) {
  Footage footage;
  footage.name = name;
  footage.setup = scene.setup;
  footage.sheet_width_m = scene.sheet_width_m;
  footage.sidelines = scene.sideline != "none";
  footage.frames = looks_at_a_scene;
  footage.first_counted = looks_before_counting;
  footage.shot = [scene](int k) {
    Shot shot;
    shot.frame.image = scene.image;
    shot.frame.stamp = Stamp{} + from_seconds(k / 60.0);
    shot.body = scene.body;
    shot.eMc = scene.eMc;
    return shot;
  };
  return footage;
}

}  // namespace

std::vector<Footage> scenes_in(const std::string& folder) {
  std::vector<std::filesystem::path> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".jpg") pictures.push_back(entry.path());
  }
  if (pictures.empty()) throw std::runtime_error("no pictures (.jpg) in " + folder);
  std::sort(pictures.begin(), pictures.end());
  std::vector<Footage> all;
  for (std::filesystem::path path : pictures) {
    path.replace_extension();
    all.push_back(standing_still(vision::testing::load_scene_file(path.string()), path.filename().string()));
  }
  return all;
}

Footage turning(bool people) {
  const auto move = people ? hogline::testing::turning_move_among_people() : hogline::testing::turning_move();
  const auto sequence = std::make_shared<hogline::testing::TurningSequence>(move);
  Footage footage;
  footage.name = people ? "turning among people" : "turning";
  footage.setup = sequence->setup();
  footage.sheet_width_m = move.rink.sheet.width_m;
  footage.frames = sequence->size();
  footage.first_counted = 1;
  footage.shot = [sequence](int k) {
    const hogline::testing::TurningFrame frame = sequence->frame(k);
    return Shot{{frame.bgr, frame.stamp, frame.gyro_yaw_increment_rad}, frame.body, frame.eMc};
  };
  return footage;
}

Footage running(bool accelerating) {
  hogline::testing::RunMove move;
  move.last_hog_distance_m = 0.72;
  if (accelerating) {
    move = hogline::testing::random_run(16);
    move.first_hog_distance_m = 2.5;
    move.last_hog_distance_m = 0.72;
  }
  const auto sequence = std::make_shared<hogline::testing::RunSequence>(move);
  Footage footage;
  footage.name = accelerating ? "accelerating run" : "run";
  footage.setup = sequence->setup();
  footage.sheet_width_m = move.rink.sheet.width_m;
  footage.frames = sequence->size();
  footage.first_counted = 1;
  footage.shot = [sequence](int k) {
    const hogline::testing::RunFrame frame = sequence->frame(k);
    return Shot{{frame.bgr, frame.stamp, 0.0}, frame.body, frame.eMc};
  };
  return footage;
}

Footage first_frames(Footage footage, int frames) {
  footage.frames = std::min(footage.frames, frames);
  footage.first_counted = std::min(footage.first_counted, footage.frames - 1);
  return footage;
}

}  // namespace hogline::bench
