#include "servo/assignment.hpp"

#include <cassert>
#include <cstddef>
#include <limits>

namespace hogline::servo {

// Rows and columns are counted from 1; column 0 stands for "not yet assigned".
std::vector<int> least_cost_assignment(const std::vector<std::vector<double>>& costs) {
  if (costs.empty()) return {};
  const std::size_t rows = costs.size(), columns = costs.front().size();
  assert(columns >= rows);
  std::vector<double> row_price(rows + 1, 0.0), column_price(columns + 1, 0.0);
  std::vector<std::size_t> row_of(columns + 1, 0), came_from(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_of[0] = row;
    std::size_t column = 0;
    std::vector<double> slack(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> reached(columns + 1, false);
    do {
      reached[column] = true;
      const std::size_t at = row_of[column];
      double least = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= columns; ++j) {
        if (reached[j]) continue;
        const double reduced = costs[at - 1][j - 1] - row_price[at] - column_price[j];
        if (reduced < slack[j]) slack[j] = reduced, came_from[j] = column;
        if (slack[j] < least) least = slack[j], next = j;
      }
      for (std::size_t j = 0; j <= columns; ++j) {
        if (reached[j]) {
          row_price[row_of[j]] += least, column_price[j] -= least;
        } else {
          slack[j] -= least;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = came_from[column]) row_of[column] = row_of[came_from[column]];
  }
  std::vector<int> column_of(rows, -1);
  for (std::size_t j = 1; j <= columns; ++j) {
    if (row_of[j] != 0) column_of[row_of[j] - 1] = static_cast<int>(j) - 1;
  }
  return column_of;
}

}  // namespace hogline::servo
