#include "src/throw_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/campaign/recall.hpp"
#include "src/exit_status.hpp"
#include "src/output/output_folder.hpp"
#include "src/throw_request.hpp"

namespace hogline {

std::string known_fault(const std::string& text) {
  if (parse_fault(text)) return {};
  if (text.find('@') == std::string::npos)
    return fmt::format("'{}' does not say when: KIND@SECONDS, e.g. {}@1.0", text, fault_names().front());
  return fmt::format("'{}' is no fault: KIND@SECONDS, from 0 s, with KIND one of {}", text,
                     fmt::join(fault_names(), ", "));
}

namespace {

int throw_again(const ThrowOptions& options) {
  auto [request, draw, row] = campaign::recall(options.from);
  if (!options.seer.empty()) request.eyes = eyes_of(options.seer);
  const OutputFolder folder("--out", options.out);
  const ThrowOutcome outcome = carry_out(options, request);
  const bool same = campaign::line_of(campaign::row_of(draw, outcome.result)) == campaign::line_of(row);
  fmt::print(stderr, "{}\n",
             same ? "as in the table, to the last digit" : "not as in the table: another seer or build");
  fmt::print("{}\n", result_line(outcome.result));
  return outcome.result.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace

int run_throw(const ThrowOptions& options) {
  if (!options.from.empty()) return throw_again(options);
  const OutputFolder folder("--out", options.out);
  const ThrowRequest request = make_request(options);
  const ThrowOutcome outcome = carry_out(options, request);
  if (!options.json_only) fmt::print("pictures, plots and the log are in {}\n", options.out);
  fmt::print("{}\n", result_line(outcome.result));
  return outcome.result.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
