// The fault table as a page of Markdown.
#pragma once

#include <string>
#include <vector>

#include "src/faults/fault_trial.hpp"

namespace hogline::faults {

struct Row {
  Case fault;
  Finding finding;
};

/// The same rows give the same bytes.
std::string fault_page(const std::vector<Row>& rows);

}  // namespace hogline::faults
