// The comparison as Markdown.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/comparison.hpp"

namespace hogline::bench {

/// One row a method.
std::string table_of(const std::vector<Column>& columns);

/// "track is 12.3 times faster than ..., 40 times more accurate": `us` against `them`, by their keys. Empty where one
/// of them is not there.
std::string ratio_of(const std::vector<Column>& columns, const std::string& us, const std::string& them);

/// The machine's processor and cores, the date, and the commit it was built from.
std::string where_and_when();

/// Puts `text` between the lines "<!-- bench:begin -->" and "<!-- bench:end -->" of a file. Throws std::runtime_error
/// when they are not there.
void put_between_markers(const std::string& path, const std::string& text);

}  // namespace hogline::bench
