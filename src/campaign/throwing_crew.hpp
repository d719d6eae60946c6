// Throws what is missing of a campaign, several throws at a time.
#pragma once

#include <functional>

#include "src/campaign/folder.hpp"
#include "src/campaign/plan.hpp"

namespace hogline::campaign {

/// Called after each row that was written, by one thread at a time.
using Tick = std::function<void(const Row& row)>;

/// Throws until the folder holds `throws` rows. Rows do not depend on `jobs`. Where a throw or the disk fails, ends the
/// throws under way and rethrows; what was written stays. Precondition: jobs >= 1.
void throw_missing(const Plan& plan, int throws, int jobs, Folder& folder, const Tick& tick);

}  // namespace hogline::campaign
