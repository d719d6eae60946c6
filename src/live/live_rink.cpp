#include "src/live/live_rink.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <variant>

#include "src/config/config_error.hpp"
#include "src/live/process.hpp"

namespace hogline {
namespace {

using config::ConfigError;

constexpr Duration world_step = std::chrono::milliseconds(1);
constexpr Duration asked_lately = std::chrono::milliseconds(300);
constexpr auto render_pause = std::chrono::milliseconds(1);

int modbus_port_of(const config::ThrowerRig& rig) {
  const auto* tcp = std::get_if<hw::ModbusTcp>(&rig.modbus.line.line);
  if (tcp != nullptr && tcp->address == "127.0.0.1") return tcp->port;
  throw ConfigError(rig.rig.file, 0, "modbus.tcp.address", tcp != nullptr ? tcp->address : std::string("rtu"),
                    "must be 127.0.0.1: the simulated rink serves this machine alone, as in config/rigs/thrower.yaml");
}

void serve_modbus(hw::sim::ModbusDevices& devices, const config::ThrowerRig& rig) {
  const int port = modbus_port_of(rig);
  try {
    devices.serve_tcp(port);
  } catch (const std::system_error& problem) {
    throw std::runtime_error(
        fmt::format("{}: modbus.tcp.port = {}: {}; end the program that has it (ss -ltnp), or give the "
                    "rig another port",
                    rig.rig.file, port, problem.what()));
  }
}

std::string segment_of(const config::Rig& rig, const std::string& camera) {
  const auto source = rig.source(camera);
  if (const auto* shared = std::get_if<config::SharedMemorySource>(&source.device)) return shared->segment;
  throw ConfigError(rig.file, 0, "cameras." + camera + ".source", "",
                    "must be shared_memory: that is where the simulated rink puts its pictures, as in "
                    "config/rigs/thrower.yaml");
}

std::string gyro_device_of(const config::ThrowerRig& rig) {
  const std::filesystem::path device = rig.gyro_port.device;
  std::error_code problem;
  if (std::filesystem::is_directory(device.parent_path(), problem)) return device;
  throw ConfigError(rig.rig.file, 0, "gyro.device", device,
                    "must be in a folder that is there: the simulated rink puts its gyro's line at this path, as in "
                    "config/rigs/thrower.yaml");
}

// Everything of this machine that the rigs name and the rink makes anew. The port and the buses have owners of their
// own.
std::vector<SoleOwner> take_all(const config::ThrowerRig& rig, const std::optional<config::SkipRig>& skip) {
  std::vector<SoleOwner> owned;
  modbus_port_of(rig);
  const auto segment = [&owned](const config::Rig& of, const char* camera) {
    owned.emplace_back("cameras." + std::string(camera) + ".source = shared memory " + segment_of(of, camera));
  };
  for (const char* camera : {"near", "low"}) segment(rig.rig, camera);
  owned.emplace_back("gyro.device = " + gyro_device_of(rig));
  if (!skip) return owned;
  for (const char* camera : {"near", "far"}) segment(skip->rig, camera);
  return owned;
}

}  // namespace

LiveRink::View::View(hw::sim::RenderedCamera& rendered, const std::string& segment, const hw::FrameRingShape& shape,
                     const LiveRink& rink)
    : camera(rendered),
      writer(segment, shape, static_cast<std::uint64_t>(rink.now().time_since_epoch().count())),
      thread([this, &rink](const std::stop_token& stop) { rink.render(*this, stop); }) {}

LiveRink::LiveRink(const config::ThrowerRig& rig, const std::optional<config::SkipRig>& skip,
                   const hw::sim::Scenario& scenario, TruthLog& log, Stamp now)
    : owned_(take_all(rig, skip)),
      robot_(rig, scenario, 1),
      ahead_(now - robot_.rink().now()),
      gyro_line_(rig.gyro_port.device),
      log_(log),
      world_(robot_.rink().now()) {
  serve_modbus(robot_.rink().modbus(), rig);
  add_view(rig.rig, "near", robot_.near_camera());
  add_view(rig.rig, "low", robot_.low_camera());
  buses_.emplace_back(rig.rig, robot_.rink().can(), now);
  if (skip) {
    hw::sim::Scenario skip_scenario = scenario;
    skip_scenario.near_camera.rate_hz = scenario.skip->far_camera.rate_hz;  // both of its cameras have one rate
    skip_.emplace(*skip, skip_scenario, 1);
    sheet_.emplace(robot_.rink(), skip_->rink(), scenario.robot, scenario.seed);
    add_view(skip->rig, "near", skip_->near_camera());
    add_view(skip->rig, "far", skip_->far_camera());
    buses_.emplace_back(skip->rig, skip_->rink().can(), now);
  }
  log_.start(now);
  log_.sample(robot_.rink().truth(), now);
}

LiveRink::~LiveRink() = default;

void LiveRink::add_view(const config::Rig& rig, const char* name, hw::sim::RenderedCamera& camera) {
  const vision::Intrinsics& lens = rig.camera(name).intrinsics;
  const hw::FrameRingShape shape{.width_px = static_cast<std::uint32_t>(lens.width_px),
                                 .height_px = static_cast<std::uint32_t>(lens.height_px),
                                 .channels = 3};
  views_.push_back(std::make_unique<View>(camera, segment_of(rig, name), shape, *this));
}

// Pictures that nobody asks for are not rendered. The beat goes on while a picture is: it takes less than any limit.
void LiveRink::render(View& view, const std::stop_token& stop) const {
  run_as_others();
  while (!stop.stop_requested()) {
    const Stamp now = std::chrono::steady_clock::now();
    view.writer.beat(now);
    auto frame = view.writer.wanted(now, asked_lately) ? view.camera.latest(world_.load()) : std::nullopt;
    if (frame) {
      frame->stamp += ahead_;
      view.writer.write(*frame);
    }
    std::this_thread::sleep_for(render_pause);
  }
}

void LiveRink::BusEnd::listen(Stamp now) {
  bus.step(now);
  while (const auto received = bus.bus().receive()) arrived.push_back(*received);
}

void LiveRink::BusEnd::deliver(Stamp until) {
  for (; !arrived.empty() && arrived.front().stamp <= until; arrived.pop_front()) rink.send(arrived.front().frame);
}

void LiveRink::BusEnd::answer() {
  while (const auto said = rink.receive()) static_cast<void>(bus.bus().send(said->frame));
}

void LiveRink::pass(Stamp now) {
  hw::sim::Rink& rink = robot_.rink();
  for (BusEnd& bus : buses_) bus.listen(now);
  if (const std::string letters = gyro_line_.read(); !letters.empty()) rink.gyro().write(letters);
  while (this->now() + world_step <= now) exchange();
  world_ = rink.now();
  gyro_line_.write(rink.read_gyro());
}

void LiveRink::exchange() {
  for (BusEnd& bus : buses_) bus.deliver(now());
  sheet_ ? sheet_->step(world_step) : robot_.rink().step(world_step);
  for (BusEnd& bus : buses_) bus.answer();
  log_.sample(robot_.rink().truth(), now());
  const bool ran = stone_runs_;
  stone_runs_ = sheet_ && sheet_->stone_runs();
  if (ran && !stone_runs_) log_.at_rest(sheet_->field().stones(), sheet_->thrown(), now());
}

bool LiveRink::put_back(std::optional<int> team) {
  if (robot_moves(robot_.rink().truth())) return false;
  if (sheet_ && sheet_->stone_runs()) return false;
  team_ = team.value_or(1 - team_);
  const hw::sim::RobotScenario& start = robot_.scenario().robot;
  if (sheet_) {
    sheet_->put_back(team_);
  } else {
    robot_.rink().put_back({start.start_x_m, start.start_y_m, start.start_yaw_rad}, team_, 0.0);
  }
  return true;
}

}  // namespace hogline
