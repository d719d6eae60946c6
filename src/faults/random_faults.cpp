#include "src/faults/random_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::faults {
namespace {

using hw::sim::mixed_bits;

constexpr double brakes_mps2 = 2.5;     // the practice rig's quick stop
constexpr double brakes_lag_s = 0.1;    // from the order to full braking
constexpr double whole_throw_s = 14.5;  // from the beginning to standstill, without a fault
constexpr double slowest_mps = 1.9;
constexpr double fastest_mps = 2.8;
constexpr std::array endings{Ending::thrown, Ending::kept,         Ending::too_late,       Ending::set_down,
                             Ending::lost,   Ending::carried_over, Ending::outside_window, Ending::not_stopped};

Moment moment_of(std::uint64_t seed, std::size_t fault, int number) {
  const std::uint64_t bits = mixed_bits(mixed_bits(mixed_bits(seed) + fault) + static_cast<std::uint64_t>(number));
  std::uint64_t drawn = 0;
  const auto draw = [&] { return hw::sim::uniform_of(mixed_bits(bits + ++drawn)); };
  Moment moment;
  moment.seed = bits >> 5U;
  moment.order = {.speed_mps = std::lerp(slowest_mps, fastest_mps, draw()),
                  .heading_rad = 0.0,
                  .curl = draw() < 0.5 ? servo::Curl::clockwise : servo::Curl::counter_clockwise,
                  .spin_radps = 1.5};
  moment.after = from_seconds(whole_throw_s * draw());
  return moment;
}

// What the fault's own limit of detection and the brakes need from the strike on.
double needed_m(const Case& fault, double speed_mps) {
  const double blind_s = seconds(fault.deadline) + brakes_lag_s;
  return speed_mps * blind_s + speed_mps * speed_mps / (2.0 * brakes_mps2);
}

Ending ending_of(const RandomStrike& s) {
  const Finding& f = s.struck.finding;
  if (!s.struck.standing) return Ending::not_stopped;
  if (f.over_the_line) return s.struck.room_m < s.needed_m ? Ending::too_late : Ending::carried_over;
  if (s.struck.set_down) return Ending::set_down;
  if (s.fault->expect == Expect::stops_without_stone && !f.held) return Ending::lost;
  if (!f.result.release) return Ending::kept;
  return std::abs(s.struck.release_error_m) <= s.struck.release_limit_m ? Ending::thrown : Ending::outside_window;
}

bool as_it_should(Ending ending) {
  return ending == Ending::thrown || ending == Ending::kept || ending == Ending::too_late ||
         ending == Ending::set_down || ending == Ending::lost;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string telling(const RandomStrike& s) {
  return fmt::format(
      "{} ({}), throw {}: {}, struck at {:.2f} s ({}, {:.2f} m/s, {:.2f} m before the limit, {:.2f} m needed): {}",
      s.fault->name, s.fault->injected, s.number, to_string(s.ending), seconds(s.moment.after),
      servo::to_string(s.struck.state), s.struck.finding.speed_mps, s.struck.room_m, s.needed_m,
      s.struck.finding.log.empty() ? "nothing was noticed" : s.struck.finding.log);
}

}  // namespace

const char* to_string(Ending ending) {
  switch (ending) {
    case Ending::thrown:
      return "let go in its window";
    case Ending::kept:
      return "stops, stone kept";
    case Ending::too_late:
      return "too late to brake";
    case Ending::set_down:
      return "stands by the stone in the hack";
    case Ending::lost:
      return "stone lost by the jaws";
    case Ending::carried_over:
      return "carried over the line";
    case Ending::outside_window:
      return "let go outside its window";
    case Ending::not_stopped:
      return "did not stop";
  }
  return "";
}

std::vector<const Case*> faults_of_any_moment() {
  std::vector<const Case*> chosen;
  for (const Case& fault : fault_table()) {
    const bool bound = fault.strike == Strike::power_on || fault.strike == Strike::rehearsing ||
                       fault.strike == Strike::set_down || fault.strike == Strike::braking;
    const bool any_moment = !bound && !fault.prepare;
    const bool again = fault.injected.starts_with("the same");
    if (any_moment && !again) chosen.push_back(&fault);
  }
  return chosen;
}

std::span<const Ending> all_endings() { return endings; }

RandomStrike drawn_strike(const std::vector<const Case*>& faults, const StrikePlace& place, std::uint64_t seed) {
  RandomStrike s;
  s.fault = faults.at(place.fault);
  s.number = place.number;
  s.moment = moment_of(seed, place.fault, place.number);
  return s;
}

std::vector<RandomStrike> strike_at_random(const std::vector<const Case*>& faults, int per_fault, std::uint64_t seed,
                                           int jobs, const StrikeTick& tick, const KnownStrikes& known) {
  const std::size_t count = faults.size() * static_cast<std::size_t>(per_fault);
  std::vector<RandomStrike> strikes(count);
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      const StrikePlace place{i % faults.size(), static_cast<int>(i / faults.size())};
      RandomStrike& s =
          strikes[place.fault * static_cast<std::size_t>(per_fault) + static_cast<std::size_t>(place.number)];
      if (const auto found = known.find(place); found != known.end()) {
        s = found->second;
        continue;
      }
      s = drawn_strike(faults, place, seed);
      s.struck = strike_at(*s.fault, s.moment);
      s.needed_m = needed_m(*s.fault, s.struck.finding.speed_mps);
      s.ending = ending_of(s);
      const std::lock_guard lock(mutex);
      try {
        if (tick && !failure) tick(place, s);
      } catch (...) {  // a full disk: the others end, too
        failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> crew;
  for (int i = 1; i < jobs; ++i) crew.emplace_back(work);
  work();
  crew.clear();
  if (failure) std::rethrow_exception(failure);
  return strikes;
}

std::string strikes_csv(const std::vector<RandomStrike>& strikes) {
  std::string text =
      "group,fault,injected,number,seed,order_mps,curl,after_s,state,speed_mps,room_m,needed_m,ending,log\n";
  for (const RandomStrike& s : strikes) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{:.4f},{},{:.3f},{:.3f},{:.3f},{},{}\n",
                   to_string(s.fault->group), quoted(s.fault->name), quoted(s.fault->injected), s.number, s.moment.seed,
                   s.moment.order.speed_mps, s.moment.order.curl == servo::Curl::clockwise ? "cw" : "ccw",
                   seconds(s.moment.after), servo::to_string(s.struck.state), s.struck.finding.speed_mps,
                   s.struck.room_m, s.needed_m, to_string(s.ending), quoted(s.struck.finding.log));
  }
  return text;
}

std::string strikes_page(const std::vector<RandomStrike>& strikes) {
  std::string text = "| fault | injected how |";
  for (const Ending e : endings) text += fmt::format(" {} |", to_string(e));
  text += "\n|---|---|";
  for (std::size_t i = 0; i < endings.size(); ++i) text += "--:|";
  text += "\n";
  std::array<int, endings.size()> all{};
  const auto line = [&](const std::string& head, const std::array<int, endings.size()>& counts) {
    text += head;
    for (const int n : counts) text += n > 0 ? fmt::format(" {} |", n) : std::string(" |");
    text += "\n";
  };
  for (auto first = strikes.begin(); first != strikes.end();) {
    const auto last =
        std::find_if(first, strikes.end(), [&](const RandomStrike& s) { return s.fault != first->fault; });
    std::array<int, endings.size()> counts{};
    for (auto s = first; s != last; ++s) {
      const auto place = static_cast<std::size_t>(std::ranges::find(endings, s->ending) - endings.begin());
      ++counts[place];
      ++all[place];
    }
    line(fmt::format("| {} | {} |", first->fault->name, first->fault->injected), counts);
    first = last;
  }
  line("| **all** | |", all);
  text += "\nNot as it should be, and too late:\n\n";
  for (const RandomStrike& s : strikes) {
    if (!as_it_should(s.ending) || s.ending == Ending::too_late) text += "- " + telling(s) + "\n";
  }
  return text;
}

bool safe(const std::vector<RandomStrike>& strikes) {
  return std::ranges::all_of(strikes, [](const RandomStrike& s) { return as_it_should(s.ending); });
}

}  // namespace hogline::faults
