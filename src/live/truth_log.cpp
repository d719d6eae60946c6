#include "src/live/truth_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

constexpr Duration moving_period = std::chrono::milliseconds(5);
constexpr Duration resting_period = std::chrono::milliseconds(200);
constexpr double resting_mps = 0.005;
constexpr double resting_radps = 0.01;
constexpr double resting_wheel_radps = 0.05;

double speed_of(const hw::sim::Truth& truth) { return std::hypot(truth.twist.forward_mps, truth.twist.left_mps); }

}  // namespace

bool robot_moves(const hw::sim::Truth& truth) {
  return speed_of(truth) > resting_mps || std::abs(truth.twist.yaw_radps) > resting_radps ||
         std::abs(truth.left_wheel_radps) > resting_wheel_radps ||
         std::abs(truth.right_wheel_radps) > resting_wheel_radps;
}

TruthLog::File::File(const std::string& path) {
  if (path.empty()) return;
  descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    throw config::ConfigError("command line", 0, "--truth", path,
                              "can not be written: " + std::generic_category().message(errno));
  }
}

TruthLog::File::~File() {
  if (descriptor >= 0) close(descriptor);
}

TruthLog::TruthLog(const std::string& path) : file_(path), lines_(file_.descriptor) {}

void TruthLog::start(Stamp now) {
  last_ = Stamp{};
  lines_.post(fmt::format("{{\"start_ns\": {}}}\n", now.time_since_epoch().count()));
}

void TruthLog::sample(const hw::sim::Truth& truth, Stamp now) {
  if (file_.descriptor < 0) return;
  lines_.pump();
  const bool arm_moves = truth.arm_unfolded != last_arm_;
  const bool moves = robot_moves(truth) || arm_moves;
  const bool changed = truth.held != last_held_ || truth.release.has_value() != last_released_;
  if (!changed && now - last_ < (moves ? moving_period : resting_period)) return;
  last_ = now;
  last_held_ = truth.held;
  last_released_ = truth.release.has_value();
  last_arm_ = truth.arm_unfolded;
  lines_.post(
      fmt::format("{{\"t_ns\": {}, \"moves\": {}, \"arm_moves\": {}, \"speed_mps\": {:.4f}, \"yaw_radps\": {:.4f}, "
                  "\"x_m\": {:.4f}, \"y_m\": {:.4f}, \"yaw_rad\": {:.5f}, \"held\": {}, \"released\": {}, "
                  "\"stone_mps\": {:.4f}, \"arm\": {:.3f}}}\n",
                  now.time_since_epoch().count(), robot_moves(truth), arm_moves, speed_of(truth), truth.twist.yaw_radps,
                  truth.body.x_m, truth.body.y_m, truth.body.yaw_rad, truth.held, truth.release.has_value(),
                  std::hypot(truth.stone.vx_mps, truth.stone.vy_mps), truth.arm_unfolded));
}

void TruthLog::at_rest(const std::vector<hw::sim::FieldStone>& stones, std::optional<std::size_t> thrown, Stamp now) {
  if (file_.descriptor < 0) return;
  std::string line = fmt::format("{{\"rest_ns\": {}, \"stones\": [", now.time_since_epoch().count());
  const char* comma = "";
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (stones[i].taken_off) continue;
    line += fmt::format("{}{{\"x_m\": {:.4f}, \"y_m\": {:.4f}, \"team\": {}, \"thrown\": {}}}", comma,
                        stones[i].motion.x_m, stones[i].motion.y_m, stones[i].team, thrown == i);
    comma = ", ";
  }
  lines_.post(line + "]}\n");
}

}  // namespace hogline
