// Line plots: several series over one axis, with units and a legend.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/drawing/canvas.hpp"

namespace hogline::drawing {

enum class SeriesStyle { line, dashed, dots };

/// Points in the order in which they are joined. A point that is not finite makes a gap; where x and y differ in length
/// the longer one's rest is left out.
struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  Ink ink = inks::blue;
  SeriesStyle style = SeriesStyle::line;
};

/// A moment with a name: release, hog line, ...
struct PlotMark {
  double x = 0.0;
  std::string name;
};

struct Plot {
  std::string title;
  std::string x_label;  ///< with its unit: "time / s"
  std::string y_label;
  std::vector<Series> series;
  std::vector<PlotMark> marks;
  std::optional<double> y_low;  ///< empty: from the data
  std::optional<double> y_high;
  std::optional<double> x_low;
  std::optional<double> x_high;
};

/// A plot without any finite point has axes from 0 to 1 and says "no data". Precondition: at least 200 by 120 pixels.
cv::Mat draw_plot(const Plot& plot, cv::Size size);

/// Plots under each other with one common range of x.
cv::Mat draw_plots(std::vector<Plot> plots, cv::Size size_of_each);

/// Where the axis' numbers go: steps of 1, 2 or 5 times a power of ten, about `wanted` of them between low and high.
/// Precondition: finite, low < high, wanted >= 1.
std::vector<double> axis_ticks(double low, double high, int wanted);

}  // namespace hogline::drawing
