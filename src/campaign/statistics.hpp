// What many numbers say.
#pragma once

#include <vector>

namespace hogline::campaign {

struct Statistics {
  int count = 0;
  double mean = 0.0;
  double sigma = 0.0;  ///< about the mean; zero for fewer than two
  double rms = 0.0;    ///< about zero
  double q05 = 0.0;
  double median = 0.0;
  double q95 = 0.0;
  double largest = 0.0;  ///< of the magnitudes
};

Statistics statistics_of(std::vector<double> values);

}  // namespace hogline::campaign
