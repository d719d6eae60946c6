// How long a look takes: one 1600x1200 picture, one thread.
#include <benchmark/benchmark.h>
#include <gsl/gsl_errno.h>

#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "tests/support/random_board.hpp"
#include "tests/support/random_far_scene.hpp"
#include "tests/support/turning_sequence.hpp"
#include "tests/vision/scene.hpp"
#include "tests/vision/stones/moving_board.hpp"
#include "vision/far_view/far_view.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/near_sequence.hpp"
#include "vision/near_view.hpp"
#include "vision/planned_sheet.hpp"
#include "vision/stone_sequence.hpp"

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

void near_acquire(benchmark::State& state, const char* name) {
  const testing::Scene scene = testing::load_scene(name);
  NearView near(scene.setup);
  double yaw_error_deg = 0.0;
  for (auto _ : state) {
    const SheetPosePercept p = near.acquire(scene.image, Stamp{});
    if (!p.ok) state.SkipWithError(p.reason.c_str());
    yaw_error_deg = (p.body.yaw_rad - scene.body.yaw_rad) / degree;
  }
  state.counters["yaw_error_mdeg"] = 1000.0 * yaw_error_deg;
}

// From a start as a good prediction gives it: a tenth of a degree and a centimetre off.
void near_fit(benchmark::State& state, const char* name) {
  const testing::Scene scene = testing::load_scene(name);
  SheetFit fit(scene.setup);
  PlanarPose start = scene.body;
  start.x_m += 0.01;
  start.y_m += 0.01;
  start.yaw_rad += 0.1 * degree;
  SheetFitStart request;
  request.eMc = eMb(start) * bMc(scene.setup.mount);
  double yaw_error_deg = 0.0;
  for (auto _ : state) {
    const SheetFitResult& result = fit.fit(scene.image, request);
    if (!result.ok) state.SkipWithError(result.reason.c_str());
    yaw_error_deg = (result.body.yaw_rad - scene.body.yaw_rad) / degree;
  }
  state.counters["yaw_error_mdeg"] = 1000.0 * yaw_error_deg;
}

hogline::testing::FarScene far_scene(int stones) {
  return hogline::testing::random_far_scene(1, {.most_stones = stones, .least_stones = stones});
}

// One picture down the sheet, without memory.
void far_look(benchmark::State& state) {
  const auto far = far_scene(static_cast<int>(state.range(0)));
  const cv::Mat picture = render(far.scene);
  FarSetup setup;
  setup.camera = far.scene.setup;
  FarView view(setup);
  FarPlan plan;
  plan.eMc = far.planned;
  double stones = 0.0;
  for (auto _ : state) stones = static_cast<double>(view.look(picture, Stamp{}, plan).stones.size());
  state.counters["stones"] = stones;
}

// One of consecutive pictures, each drawn with its own noise, after a quarter of a second.
void far_track(benchmark::State& state) {
  const auto far = far_scene(static_cast<int>(state.range(0)));
  const hogline::hw::sim::SheetRenderer renderer(far.scene.setup.intrinsics, far.scene.setup.ice, far.scene.rink,
                                                 far.scene.sensor, 1);
  std::vector<cv::Mat> pictures(8);
  for (std::size_t k = 0; k < pictures.size(); ++k) renderer.render(far.scene.exposure, k, pictures[k]);
  FarSetup setup;
  setup.camera = far.scene.setup;
  FarSequence sequence(setup);
  FarPlan plan;
  plan.eMc = far.planned;
  Stamp stamp{};
  std::size_t k = 0;
  double stones = 0.0;
  const auto step = [&] {
    stamp += from_seconds(1.0 / 30.0);
    stones = static_cast<double>(sequence.look(pictures[k++ % pictures.size()], stamp, plan, {}).stones.size());
  };
  for (int i = 0; i < 8; ++i) step();
  for (auto _ : state) step();
  state.counters["stones"] = stones;
}

/// The skip's near view of the first board from a seed on with so many stones, and pictures of it, each with its own
/// noise.
struct SeenBoard {
  explicit SeenBoard(std::size_t stones, std::uint64_t from = 1, std::size_t count = 8) : seed(from), pictures(count) {
    for (board = hogline::testing::random_board(seed); board.stones.size() != stones;)
      board = hogline::testing::random_board(++seed);
    const auto& scene = board.scene;
    const hogline::hw::sim::SheetRenderer renderer(scene.setup.intrinsics, scene.setup.ice, scene.rink, scene.sensor,
                                                   scene.seed);
    for (std::size_t k = 0; k < pictures.size(); ++k) renderer.render(scene.exposure, k, pictures[k]);
    setup.camera = scene.setup;
  }
  std::uint64_t seed;
  hogline::testing::RandomBoard board;
  std::vector<cv::Mat> pictures;
  StonesSetup setup;
};

// The stones of one picture without memory, the pose known: sixteen boards in turn, for some cost thrice what others
// do. Their median is hogline_stones_time's.
void near_stones_find(benchmark::State& state) {
  std::vector<SeenBoard> boards;
  std::vector<StoneFinder> finders;
  for (std::uint64_t seed = 1; boards.size() < 16; seed = boards.back().seed + 1) {
    boards.emplace_back(static_cast<std::size_t>(state.range(0)), seed, 1);
    finders.emplace_back(boards.back().setup);
  }
  std::size_t k = 0;
  double stones = 0.0;
  for (auto _ : state) {
    const SeenBoard& seen = boards[k];
    const auto& scene = seen.board.scene;
    stones +=
        static_cast<double>(finders[k].find(seen.pictures[0], Stamp{}, scene.eMc, scene.sheet_width_m).stones.size());
    k = (k + 1) % boards.size();
  }
  state.counters["stones"] = stones / static_cast<double>(state.iterations());
}

// The same of consecutive pictures: every part of the search has its turn.
void near_stones_track(benchmark::State& state) {
  const SeenBoard seen(static_cast<std::size_t>(state.range(0)));
  StoneSequence sequence(seen.setup);
  Stamp stamp{};
  std::size_t k = 0;
  double stones = 0.0;
  const auto step = [&] {
    stamp += from_seconds(1.0 / 60.0);
    const cv::Mat& picture = seen.pictures[k++ % seen.pictures.size()];
    const auto& scene = seen.board.scene;
    stones = static_cast<double>(sequence.look(picture, stamp, scene.eMc, scene.sheet_width_m, {}).stones.size());
  };
  for (int i = 0; i < 8; ++i) step();
  for (auto _ : state) step();
  state.counters["stones"] = stones;
}

/// A board with eight stones in sight at 60 pictures a second, of which one is struck and runs, its handle in sight;
/// the head is thought to point a tenth of a degree off where it does.
class RunningStone {
 public:
  RunningStone() {
    for (int k = 0; k < count; ++k) pictures_.push_back(board_.picture(k));
    planned_ = scene().eMc * Eigen::AngleAxisd(0.1 * degree, Eigen::Vector3d::UnitY());
  }
  const hogline::testing::RandomScene& scene() const { return board_.board().scene; }
  StonesSetup setup() const { return board_.setup(); }
  const Pose& planned() const { return planned_; }

  /// The next picture, and when it was taken. After the last one `work` begins anew, by itself, with the first ones.
  template <typename Work>
  void step(benchmark::State* state, const Work& work) {
    const bool again = at_ == count;
    if (again && state != nullptr) state->PauseTiming();
    if (again) {
      at_ = 0;
      begin_ += from_seconds(10.0);
    }
    while (at_ < first) show(work);
    if (again && state != nullptr) state->ResumeTiming();
    show(work);
  }

 private:
  static constexpr int first = 12;  ///< of those that are measured: by then the stone is known to run
  static constexpr int count = 36;

  template <typename Work>
  void show(const Work& work) {
    const int k = at_++;
    work(pictures_[static_cast<std::size_t>(k)], begin_ + (board_.stamp(k) - Stamp{}));
  }

  testing::MovingBoard board_{26, {.rate_hz = 60.0, .struck_at = 2, .speed_mps = 1.5, .walker = false}};
  std::vector<cv::Mat> pictures_;
  Pose planned_;
  Stamp begin_{};
  int at_ = 0;
};

// The sheet by a head's joints, as the skip sees it from picture to picture.
void near_planned_sheet(benchmark::State& state) {
  RunningStone board;
  PlannedSheet sheet(board.setup().camera);
  double tracked = 0.0;
  double frames = 0.0;
  const auto look = [&](const cv::Mat& picture, Stamp stamp) {
    const SheetFitResult& result = sheet.look(picture, stamp, board.planned(), board.scene().sheet_width_m);
    if (!result.ok) state.SkipWithError(result.reason.c_str());
    ++frames;
    tracked += sheet.tracked() ? 1.0 : 0.0;
  };
  board.step(nullptr, look);
  tracked = frames = 0.0;
  for (auto _ : state) board.step(&state, look);
  state.counters["tracked"] = tracked / frames;
}

// All that the skip does with a near picture while a throw is followed: the sheet, all stones, the running one's
// handle.
void near_frame(benchmark::State& state) {
  RunningStone board;
  PlannedSheet sheet(board.setup().camera);
  StoneSequence sequence(board.setup());
  double tracked = 0.0;
  double stones = 0.0;
  double handles = 0.0;
  double frames = 0.0;
  const auto look = [&](const cv::Mat& picture, Stamp stamp) {
    const SheetFitResult& result = sheet.look(picture, stamp, board.planned(), board.scene().sheet_width_m);
    if (!result.ok) state.SkipWithError(result.reason.c_str());
    const StonesPercept seen = sequence.look(picture, stamp, result.eMc, board.scene().sheet_width_m, {});
    ++frames;
    tracked += sheet.tracked() ? 1.0 : 0.0;
    stones += static_cast<double>(seen.stones.size());
    for (const StoneSighting& s : seen.stones) handles += s.handle_rad ? 1.0 : 0.0;
  };
  board.step(nullptr, look);
  stones = handles = tracked = frames = 0.0;
  for (auto _ : state) board.step(&state, look);
  state.counters["tracked"] = tracked / frames;
  state.counters["stones"] = stones / frames;
  state.counters["handles"] = handles / frames;
}

// A frame of a robot that turns at 20 deg/s, to and fro: eight frames are drawn, so that each comes from memory anew.
void near_track(benchmark::State& state) {
  const hogline::testing::TurningSequence sequence(hogline::testing::turning_move());
  std::vector<hogline::testing::TurningFrame> frames;
  for (int k = 24; k < 32; ++k) frames.push_back(sequence.frame(k));
  NearSequence near(sequence.setup());
  Stamp stamp{};
  near.step(frames[0].bgr, stamp);
  double square_deg2 = 0.0;
  std::size_t at = 0;
  bool forward = true;
  for (auto _ : state) {
    const std::size_t before = at;
    forward = at == 0 || (forward && at + 1 < frames.size());
    at += forward ? 1 : -1;
    stamp += from_seconds(1.0 / 60.0);
    const double turned_rad = frames[at].body.yaw_rad - frames[before].body.yaw_rad;
    const SheetPosePercept& p = near.step(frames[at].bgr, stamp, turned_rad);
    if (!near.diagnosis().tracked) state.SkipWithError(near.diagnosis().lost.c_str());
    const double error_deg = (p.body.yaw_rad - frames[at].body.yaw_rad) / degree;
    square_deg2 += error_deg * error_deg;
  }
  state.counters["yaw_rms_mdeg"] = 1000.0 * std::sqrt(square_deg2 / static_cast<double>(state.iterations()));
}

BENCHMARK_CAPTURE(near_acquire, plain, "near/near-11-000")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(near_acquire, no_sidelines, "near/near-11-003")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(near_acquire, stones, "skip/skip-12-002")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(near_fit, plain, "near/near-11-000")->Unit(benchmark::kMillisecond);
BENCHMARK(near_track)->Unit(benchmark::kMillisecond);
BENCHMARK(near_stones_find)->Arg(8)->Iterations(64)->Unit(benchmark::kMillisecond);
BENCHMARK(near_stones_track)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(near_planned_sheet)->Unit(benchmark::kMillisecond);
BENCHMARK(near_frame)->Unit(benchmark::kMillisecond);
BENCHMARK(far_look)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(far_track)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hogline::vision

int main(int argc, char** argv) {
  gsl_set_error_handler_off();
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
