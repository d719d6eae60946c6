#include "src/faults_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/config/config_error.hpp"
#include "src/exit_status.hpp"
#include "src/faults/fault_page.hpp"
#include "src/output/output_file.hpp"

namespace hogline {
namespace {

void tell(const faults::Case& fault, const faults::Finding& finding) {
  fmt::print(stderr, "{:6} {} ({}, {}): {}\n", to_string(fault.group), fault.name, fault.injected,
             to_string(fault.strike),
             finding.failures.empty() ? "as it should be" : fmt::format("{}", fmt::join(finding.failures, "; ")));
}

// Before the first throw: a table takes a minute.
void check(const FaultsOptions& options) {
  const auto table = faults::fault_table();
  if (std::ranges::none_of(table, [&](const faults::Case& fault) { return mentions(fault, options.only); })) {
    throw config::ConfigError("command line", 0, "--only", options.only,
                              "no fault's group, name or way of injection contains it; doc/faults.md lists them");
  }
  if (!options.out.empty()) check_file("--out", options.out);
}

}  // namespace

int run_faults(const FaultsOptions& options) {
  check(options);
  std::vector<faults::Row> rows;
  bool all_well = true;
  for (const faults::Case& fault : faults::fault_table()) {
    if (!mentions(fault, options.only)) continue;
    rows.push_back({fault, faults::try_fault(fault)});
    tell(fault, rows.back().finding);
    all_well = all_well && (rows.back().finding.failures.empty() || !fault.shortcoming.empty());
  }
  const std::string page = fault_page(rows);
  if (options.out.empty()) {
    fmt::print("{}", page);
  } else {
    write_text(options.out, page);
  }
  return all_well ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
