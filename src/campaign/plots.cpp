#include "src/campaign/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "src/campaign/summary.hpp"
#include "src/drawing/plot.hpp"

namespace hogline::campaign {
namespace {

const cv::Size tile(480, 250);
constexpr int tiles_across = 2;

// The outline of a histogram.
drawing::Series outline(const std::vector<double>& values) {
  drawing::Series series{.name = "throws", .x = {}, .y = {}, .ink = drawing::inks::blue};
  if (values.empty()) return series;
  const auto [low, high] = std::ranges::minmax(values);
  const int bins = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(values.size())) * 2.0), 5, 60);
  const double width = std::max((high - low) / bins, 1e-9);
  std::vector<int> counts(static_cast<std::size_t>(bins), 0);
  for (const double v : values)
    ++counts[static_cast<std::size_t>(std::min(static_cast<int>((v - low) / width), bins - 1))];
  const auto add = [&](double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
  };
  add(low, 0.0);
  for (int i = 0; i < bins; ++i) {
    add(low + i * width, counts[static_cast<std::size_t>(i)]);
    add(low + (i + 1) * width, counts[static_cast<std::size_t>(i)]);
  }
  add(low + bins * width, 0.0);
  return series;
}

drawing::Plot plot_of(const Measure& m, const std::vector<Row>& rows) {
  std::vector<double> values;
  for (const Row& row : rows) {
    if (row.*m.field) values.push_back(*(row.*m.field));
  }
  const Statistics s = statistics_of(values);
  drawing::Plot plot;
  plot.title = fmt::format("{}: RMS {:.3g} {}, largest {:.3g}", m.name, s.rms, m.unit, s.largest);
  plot.x_label = m.name + " / " + m.unit;
  plot.y_label = "throws";
  plot.series.push_back(outline(values));
  plot.y_low = 0.0;
  return plot;
}

}  // namespace

cv::Mat distributions(const std::vector<Row>& rows) {
  const int count = static_cast<int>(measures().size());
  const int down = (count + tiles_across - 1) / tiles_across;
  cv::Mat sheet(down * tile.height, tiles_across * tile.width, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    const cv::Point corner((i % tiles_across) * tile.width, (i / tiles_across) * tile.height);
    draw_plot(plot_of(measures()[static_cast<std::size_t>(i)], rows), tile).copyTo(sheet(cv::Rect(corner, tile)));
  }
  return sheet;
}

}  // namespace hogline::campaign
