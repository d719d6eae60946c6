#include "src/throw_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/exit_status.hpp"
#include "src/throw_request.hpp"

namespace hogline {

std::string known_fault(const std::string& text) {
  if (parse_fault(text)) return {};
  return fmt::format("'{}' is no fault: KIND@SECONDS with KIND one of {}", text, fmt::join(fault_names(), ", "));
}

int run_throw(const ThrowOptions& options) {
  const ThrowRequest request = make_request(options);
  const ThrowOutcome outcome = carry_out(options, request);
  if (!options.json_only) fmt::print("pictures, plots and the log are in {}\n", options.out);
  fmt::print("{}\n", result_line(outcome.result));
  return outcome.result.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
