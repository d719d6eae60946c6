// Which look is of which stone: the assignment of least cost.
#pragma once

#include <vector>

namespace hogline::servo {

/// `costs[row][column]`, finite, every row as long, at least as many columns as rows. The column of each row, no column
/// twice, least sum (Kuhn and Munkres, by shortest augmenting paths; cubic).
std::vector<int> least_cost_assignment(const std::vector<std::vector<double>>& costs);

}  // namespace hogline::servo
