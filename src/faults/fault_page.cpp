#include "src/faults/fault_page.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hogline::faults {
namespace {

constexpr const char* head = R"(# Faults: what was injected, and what became of it

Written by `hogline faults` from the table in `src/faults`; do not edit. Each row is one whole simulated throw of a stone
at 2.5 m/s, with the fault injected into the simulated wires and devices: CAN frames, Modbus answers, the gyro's bytes,
camera frames, the control period. Percepts come from the simulator's truth with vision's errors; the picture checks
look at rendered pictures of a sixteenth of the width.

- *when*: run = at full speed; turn = while aligning; braking = 0.1 s into the stop for another fault; last metre = too
  near the hog line to stop before it; release = just after the order to open.
- *detected*: from the injection until the controller gave up the throw, and the deadline that the test asks for.
- *stopped*: from the injection (the first of two) until body and wheels stood, and the way until then. Wheels brake at
  2.5 m/s2: 1.0 s and 1.25 m from 2.5 m/s without any delay. A robot that needs a longer way than that and its delay
  is not said to stop: it *rolls until friction stops it*.
- *kept*: the stone was not let go. After each stop the cause was taken away, three seconds passed, everything was
  re-armed, and three more passed: nothing moved, or the row stands under the last heading.
- Modbus exchanges take no simulated time: on steel a lost answer is noticed up to the response timeout later, and
  before that by the age limit of the gripper's state (0.1 s).

)";

constexpr const char* elsewhere = R"(
## Tested on the real interface instead

| fault | where |
|---|---|
| bus-off by real error frames, link down and up, adapter re-created, ENOBUFS of the kernel's queue, CAN FD frames | tests/hil, on vcan and slcan |
| wall-clock step | tests/hw/socketcan/receive_stamp_test.cpp: stamps are in the steady clock; nothing else reads the wall clock |
| disk full | tests/hw/socketcan/candump_file_test.cpp: a log loses lines and counts them, the loop never waits |
| incomplete frames of a GigE camera, a camera without a first frame | tests/hw/aravis |
| configuration missing, out of range, not a number | tests/src/config: refused at the start with file, key, value and what is allowed |
)";

const char* when(Strike strike) {
  switch (strike) {
    case Strike::aligning:
      return "turn";
    default:
      return to_string(strike);
  }
}

std::string outcome_of(const Row& row) {
  const Finding& f = row.finding;
  switch (row.fault.expect) {
    case Expect::goes_on:
      return f.result.ok ? "throw goes on" : "throw given up";
    case Expect::does_not_start:
      return "does not start";
    default:
      break;
  }
  const std::string stops = f.braked ? "stops" : f.stopped_after_s ? "rolls until friction stops it" : "does not stop";
  if (row.fault.strike == Strike::set_down && !f.held) return stops + ", stone stands in the hack";
  if (row.fault.expect == Expect::stops_without_stone) return stops + ", stone lost by the jaws";
  if (!f.held) return f.result.release ? "stone let go in its window, " + stops : stops + ", stone lost";
  return stops + (f.over_the_line ? ", stone kept beyond the hog line" : ", stone kept");
}

std::string in_ms(const std::optional<double>& span_s) { return span_s ? fmt::format("{:.0f}", 1e3 * *span_s) : "-"; }

std::string line_of(const Row& row) {
  const Finding& f = row.finding;
  const bool goes_on = row.fault.expect == Expect::goes_on;
  const bool stands = row.fault.expect == Expect::does_not_start;
  const std::string limit = goes_on ? "" : fmt::format(" / {:.0f}", 1e3 * seconds(row.fault.deadline));
  std::string words = goes_on && f.log.empty() ? "-" : f.log;
  std::replace(words.begin(), words.end(), '|', '/');
  return fmt::format("| {} | {} | {} | {}{} | {} | {} | {} | {} |\n", row.fault.name, row.fault.injected,
                     when(row.fault.strike), goes_on ? "-" : in_ms(f.detected_after_s), limit,
                     goes_on || stands || !f.stopped_after_s ? "-" : fmt::format("{:.2f}", *f.stopped_after_s),
                     goes_on || stands ? "-" : fmt::format("{:.2f}", f.stop_distance_m), outcome_of(row), words);
}

std::string group_of(const std::vector<Row>& rows, Group group) {
  std::string text = fmt::format(
      "## {}\n\n| fault | injected how | when | detected / limit [ms] | stopped [s] | way [m] | outcome | log |\n"
      "|---|---|---|---|---|---|---|---|\n",
      to_string(group));
  for (const Row& row : rows) {
    if (row.fault.group == group) text += line_of(row);
  }
  return text + "\n";
}

std::string shortcomings(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    if (row.finding.failures.empty() && row.fault.shortcoming.empty()) continue;
    text += fmt::format("- **{}** ({}, {}): {}\n", row.fault.name, row.fault.injected, when(row.fault.strike),
                        row.fault.shortcoming.empty() ? fmt::format("{}", fmt::join(row.finding.failures, "; "))
                                                      : row.fault.shortcoming);
  }
  return "\n## Not survived as it should be\n\n" + (text.empty() ? "None.\n" : text);
}

}  // namespace

std::string fault_page(const std::vector<Row>& rows) {
  std::string page = head;
  for (const Group group : {Group::can, Group::modbus, Group::gyro, Group::camera, Group::host}) {
    page += group_of(rows, group);
  }
  page.pop_back();
  return page + elsewhere + shortcomings(rows);
}

}  // namespace hogline::faults
