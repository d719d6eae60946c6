#include "src/order_command.hpp"

#include <fmt/format.h>

#include <numbers>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "src/config/config_error.hpp"
#include "src/config/device_rig.hpp"
#include "src/exit_status.hpp"
#include "src/live/process.hpp"
#include "src/team/link_end.hpp"

namespace hogline {
namespace {

using namespace std::chrono_literals;

constexpr Duration throw_limit = 120s;
constexpr Duration answer_limit = 3s;

const char* word(hw::ThrowerPhase phase) {
  constexpr const char* words[] = {"idle", "aligning", "running", "released", "stopped", "fault"};
  return words[static_cast<std::size_t>(phase)];
}

// Who is there, what the thrower says, and the one order.
class Commander {
 public:
  Commander(const config::DeviceRig& rig, const OrderOptions& options)
      : name_(rig.link->robot),
        thrower_(rig.link->peers.front()),
        options_(options),
        link_(*rig.link, clock_.now(), hw::TeamTime{std::chrono::system_clock::now().time_since_epoch()}),
        end_(link_, name_, thrower_),
        start_(clock_.now()) {}

  /// False once there is nothing more to wait for.
  bool step() {
    const Stamp now = clock_.now();
    pump_told();
    end_.step(now);
    while (const auto received = end_.receive(now)) hear(received->message);
    watch_peer(now);
    if (finished_) return options_.stay;
    const bool armed = state_ && state_->armed && state_->origin.session == end_.peer_session(now);
    if (!ordered_at_ && armed && link_.matched_readers(0) > 0 && end_.answered(now)) order(now);
    const Stamp end = ordered_at_ ? *ordered_at_ + throw_limit : start_ + from_seconds(options_.wait_s);
    if (now > end) finish(ordered_at_ ? "the thrower does not come to an end" : "the thrower was not armed in time");
    const bool taken = state_ && state_->order_serial == serial_;
    if (ordered_at_ && !taken && now > *ordered_at_ + answer_limit) finish("the order was not taken");
    return true;
  }
  bool thrown() const { return released_; }
  /// However it ends, it is told once.
  void end_by_operator() {
    if (!finished_) finish("ended by its operator");
  }

 private:
  void order(Stamp now) {
    ordered_at_ = now;
    hw::ShotOrderMessage order;
    order.thrower_session = state_->origin.session;
    order.shot = 1;
    order.speed_mps = options_.speed_mps;
    order.heading_rad = options_.heading_deg * std::numbers::pi / 180.0;
    order.spin_radps = options_.spin_radps;
    end_.send(order, now);
    tell(name_, "ordered",
         fmt::format("{:.3f} m/s, {:.2f} deg, {:+.2f} rad/s", order.speed_mps, options_.heading_deg, order.spin_radps));
  }

  void hear(const hw::TeamMessage& message) {
    if (const auto* state = std::get_if<hw::ThrowerStateMessage>(&message)) hear_state(*state);
    if (const auto* release = std::get_if<hw::ReleaseMessage>(&message)) {
      if (release->order_serial != serial_) return;
      released_ = true;
      tell(name_, "release heard",
           fmt::format("{:.3f} m before the hog line at {:.3f} m/s", release->hog_distance_m, release->speed_mps));
    }
  }

  void hear_state(const hw::ThrowerStateMessage& state) {
    const bool news =
        !state_ || state_->phase != state.phase || state_->reason != state.reason || state_->armed != state.armed;
    const bool anew = state_ && state_->origin.session != state.origin.session;
    state_ = state;
    if (news) {
      tell(name_, "thrower",
           fmt::format("{}{}{}", word(state.phase), state.armed ? ", armed" : "",
                       state.reason.empty() ? "" : ": " + state.reason));
    }
    if (!ordered_at_ || finished_) return;
    const bool ours = state.order_serial == serial_ && !anew;
    if (anew) finish("the thrower was started anew");
    const bool over = state.phase == hw::ThrowerPhase::stopped || state.phase == hw::ThrowerPhase::fault ||
                      (state.phase == hw::ThrowerPhase::idle && released_);
    if (ours && over) finish(state.reason);
  }

  void watch_peer(Stamp now) {
    const bool there = end_.missing(now).empty();
    if (there != there_) tell(name_, there ? "heard" : "silent", thrower_);
    there_ = there;
  }

  void finish(const std::string& reason) {
    finished_ = true;
    tell(name_, released_ ? "thrown" : "not thrown", reason);
  }

  static constexpr std::uint64_t serial_ = 1;  // of the first message of its kind

  std::string name_;
  std::string thrower_;
  OrderOptions options_;
  hw::SteadyClock clock_;
  hw::link::DdsTeamLink link_;
  LinkEnd end_;
  Stamp start_;
  std::optional<hw::ThrowerStateMessage> state_;
  std::optional<Stamp> ordered_at_;
  bool there_ = false;
  bool released_ = false;
  bool finished_ = false;
};

}  // namespace

int run_order(const OrderOptions& options) {
  listen_for_the_end();
  const config::DeviceRig rig = config::load_device_rig(options.rig);
  if (!rig.link) throw config::ConfigError(rig.rig.file, 0, "link", "", "missing; the order goes over it");
  if (rig.link->robot != "skip") {
    throw config::ConfigError(rig.rig.file, 0, "link.robot", rig.link->robot,
                              "must be skip: nobody else's orders are thrown");
  }
  tell(rig.link->robot, "waiting", "for the thrower to be heard, and armed");
  Commander commander(rig, options);
  while (commander.step() && !asked_to_end()) std::this_thread::sleep_for(5ms);
  commander.end_by_operator();
  return commander.thrown() ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
