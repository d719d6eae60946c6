#include "src/live/live_rink.hpp"

#include <variant>

#include "src/config/config_error.hpp"
#include "src/live/process.hpp"
#include "src/throwing/rink_of_rig.hpp"

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
                    "must be 127.0.0.1: the simulated rink serves this machine alone");
}

std::string segment_of(const config::ThrowerRig& rig, const std::string& camera) {
  const auto source = rig.rig.source(camera);
  if (const auto* shared = std::get_if<config::SharedMemorySource>(&source.device)) return shared->segment;
  throw ConfigError(rig.rig.file, 0, "cameras." + camera + ".source", "",
                    "must be shared_memory: that is where the simulated rink puts its pictures");
}

}  // namespace

LiveRink::View::View(hw::sim::RenderedCamera rendered, const std::string& segment, const hw::FrameRingShape& shape,
                     std::uint64_t session, const std::atomic<Stamp>& world)
    : camera(std::move(rendered)),
      writer(segment, shape, session),
      thread([this, &world](const std::stop_token& stop) { render(*this, world, stop); }) {}

LiveRink::LiveRink(const config::ThrowerRig& rig, const hw::sim::Scenario& scenario, TruthLog& log, Stamp now)
    : scenario_(completed(scenario, rig)),
      rink_(rink_config(rig, scenario_), now),
      bus_(rig.rig, now),
      gyro_line_(rig.gyro_port.device),
      log_(log),
      world_(now) {
  rink_.modbus().serve_tcp(modbus_port_of(rig));
  add_view(rig, "near");
  add_view(rig, "low");
  log_.start(now);
  log_.sample(rink_.truth());
}

LiveRink::~LiveRink() = default;

void LiveRink::add_view(const config::ThrowerRig& rig, const char* name) {
  const vision::CameraSetup& setup = rig.rig.camera(name);
  const bool near = std::string_view(name) == "near";
  const hw::FrameRingShape shape{.width_px = static_cast<std::uint32_t>(setup.intrinsics.width_px),
                                 .height_px = static_cast<std::uint32_t>(setup.intrinsics.height_px),
                                 .channels = 3};
  const auto session = static_cast<std::uint64_t>(rink_.start().time_since_epoch().count());
  views_.push_back(std::make_unique<View>(near ? hw::sim::near_camera(rink_, scenario_, camera_rig(setup), 1)
                                               : hw::sim::low_camera(rink_, scenario_, camera_rig(setup), 1),
                                          segment_of(rig, name), shape, session, world_));
}

// Pictures that nobody asks for are not rendered. The beat goes on while a picture is: it takes less than any limit.
void LiveRink::render(View& view, const std::atomic<Stamp>& world, const std::stop_token& stop) {
  run_as_others();
  while (!stop.stop_requested()) {
    const Stamp now = std::chrono::steady_clock::now();
    view.writer.beat(now);
    const auto frame = view.writer.wanted(now, asked_lately) ? view.camera.latest(world.load()) : std::nullopt;
    if (frame) view.writer.write(*frame);
    std::this_thread::sleep_for(render_pause);
  }
}

void LiveRink::pass(Stamp now) {
  bus_.step(now);
  while (const auto received = bus_.bus().receive()) arrived_.push_back(*received);
  if (const std::string letters = gyro_line_.read(); !letters.empty()) rink_.gyro().write(letters);
  while (rink_.now() + world_step <= now) exchange();
  world_ = rink_.now();
  gyro_line_.write(rink_.read_gyro());
}

void LiveRink::exchange() {
  for (; !arrived_.empty() && arrived_.front().stamp <= rink_.now(); arrived_.pop_front())
    rink_.can().send(arrived_.front().frame);
  rink_.step(world_step);
  while (const auto said = rink_.can().receive()) static_cast<void>(bus_.bus().send(said->frame));
  log_.sample(rink_.truth());
}

}  // namespace hogline
