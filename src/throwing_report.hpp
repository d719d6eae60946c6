// What a throw leaves in its folder: pictures with what was seen, the sheet from above, plots, the log, the result.
#pragma once

#include <string>

#include "src/throwing/simulated_throw.hpp"

namespace hogline {

/// Writes near.png, low.png, sheet.png, plots.png, overview.png (all of them on one page), log.csv and result.json into
/// `folder`, making it where needed. Throws std::runtime_error that names what could not be written.
void write_report(const std::string& folder, const ThrowRequest& request, const ThrowOutcome& outcome);

}  // namespace hogline
