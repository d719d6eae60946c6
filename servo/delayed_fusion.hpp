// A Kalman filter over a short history: measurements that arrive late, or out of order, act at their own stamp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// What became of a measurement.
enum class Fusion {
  accepted,
  gated,      ///< its innovation is not believable
  too_old,    ///< older than the history
  duplicate,  ///< one of the same stamp has been taken
};

/// The history. Inputs (odometry, gyro) arrive in order; a measurement is put at its stamp and everything after it is
/// computed again. `Model` supplies types State, Input, Measurement and
///   void hold(State&, double dt_s) const                  propagate with the input in force
///   void drive(State&, double dt_s, const Input&) const   propagate up to a new input and take it
///   bool correct(State&, const Measurement&) const        false, and the state untouched, when gated
template <class Model>
class DelayedFusion {
 public:
  using State = typename Model::State;
  using Input = typename Model::Input;
  using Measurement = typename Model::Measurement;

  DelayedFusion(Model model, Duration span, Stamp start, const State& initial)
      : model_(std::move(model)), span_(span), oldest_stamp_(start), oldest_(initial) {
    events_.reserve(1024);
  }

  /// An input newer than all before it; any other is dropped (false).
  bool input(Stamp stamp, const Input& input) {
    if (last_input_ && stamp <= *last_input_) return false;
    if (stamp < oldest_stamp_) return false;
    last_input_ = stamp;
    insert(stamp, input);
    forget(stamp - span_);
    return true;
  }

  Fusion measure(Stamp stamp, const Measurement& measurement) {
    if (stamp < oldest_stamp_) return Fusion::too_old;
    const auto same = [&](const Event& e) { return e.stamp == stamp && std::holds_alternative<Measurement>(e.what); };
    if (std::any_of(events_.begin(), events_.end(), same)) return Fusion::duplicate;
    const std::size_t at = insert(stamp, measurement);
    return events_[at].accepted ? Fusion::accepted : Fusion::gated;
  }

  /// The state at a stamp, propagated with the newest input when it is later than all events.
  State at(Stamp stamp) const {
    State state = oldest_;
    Stamp since = oldest_stamp_;
    for (auto event = events_.rbegin(); event != events_.rend(); ++event) {
      if (event->stamp > stamp) continue;
      state = event->after;
      since = event->stamp;
      break;
    }
    model_.hold(state, std::max(0.0, seconds(stamp - since)));
    return state;
  }

  /// Forgets all events and goes on from a known state.
  void restart(Stamp start, const State& state) {
    events_.clear();
    oldest_stamp_ = start;
    oldest_ = state;
    last_input_.reset();
  }

 private:
  struct Event {
    Stamp stamp{};
    std::variant<Input, Measurement> what;
    State after{};
    bool accepted = true;
  };

  template <class What>
  std::size_t insert(Stamp stamp, const What& what) {
    std::size_t at = events_.size();
    while (at > 0 && events_[at - 1].stamp > stamp) --at;
    events_.insert(events_.begin() + static_cast<std::ptrdiff_t>(at), Event{stamp, what, State{}, true});
    for (std::size_t i = at; i < events_.size(); ++i) replay(i);
    return at;
  }

  void replay(std::size_t i) {
    Event& event = events_[i];
    event.after = i == 0 ? oldest_ : events_[i - 1].after;
    const double dt_s = seconds(event.stamp - (i == 0 ? oldest_stamp_ : events_[i - 1].stamp));
    if (const auto* input = std::get_if<Input>(&event.what)) {
      model_.drive(event.after, dt_s, *input);
    } else {
      model_.hold(event.after, dt_s);
      event.accepted = model_.correct(event.after, std::get<Measurement>(event.what));
    }
  }

  void forget(Stamp before) {
    std::size_t count = 0;
    while (count < events_.size() && events_[count].stamp < before) ++count;
    if (count == 0) return;
    oldest_ = events_[count - 1].after;
    oldest_stamp_ = events_[count - 1].stamp;
    events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(count));
  }

  Model model_;
  Duration span_;
  Stamp oldest_stamp_;
  State oldest_;
  std::optional<Stamp> last_input_;
  std::vector<Event> events_;
};

}  // namespace hogline::servo
