#include "src/drawing/contact_sheet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "src/drawing/canvas.hpp"

namespace hogline::drawing {
namespace {

constexpr int gap_px = 14;
constexpr double caption_px = 10.0;

// One row, or an empty picture where it has no panels.
cv::Mat draw_row(const std::vector<Panel>& row, int page_width_px) {
  double shapes = 0.0;  // widths over heights
  int count = 0;
  bool captioned = false;
  for (const Panel& panel : row) {
    if (panel.picture.empty()) continue;
    shapes += static_cast<double>(panel.picture.cols) / panel.picture.rows;
    captioned = captioned || !panel.caption.empty();
    ++count;
  }
  if (count == 0) return {};

  const int height = std::max(1, static_cast<int>((page_width_px - gap_px * (count + 1)) / shapes));
  const int below = captioned ? static_cast<int>(2.4 * caption_px) : 0;
  Canvas canvas({page_width_px, height + below}, inks::paper);
  cv::Mat drawn = canvas.picture();
  int x = gap_px;
  std::vector<std::pair<int, const Panel*>> placed;
  for (const Panel& panel : row) {
    if (panel.picture.empty()) continue;
    const int room = page_width_px - gap_px - x;
    const int width =
        std::clamp(static_cast<int>(std::lround(static_cast<double>(height) * panel.picture.cols / panel.picture.rows)),
                   1, std::max(1, room));
    cv::Mat scaled;
    cv::resize(panel.picture, scaled, {width, height}, 0.0, 0.0, cv::INTER_AREA);
    scaled.copyTo(drawn(cv::Rect(x, 0, width, height)));
    placed.emplace_back(x, &panel);
    x += width + gap_px;
  }
  if (!captioned) return drawn;
  Canvas captions({page_width_px, below}, inks::paper);
  for (const auto& [left, panel] : placed) {
    captions.text({static_cast<double>(left), 1.6 * caption_px}, panel->caption, caption_px, inks::text);
  }
  captions.picture().copyTo(drawn.rowRange(height, height + below));
  return drawn;
}

}  // namespace

cv::Mat draw_contact_sheet(const std::vector<std::vector<Panel>>& rows, int page_width_px) {
  assert(page_width_px >= 200);
  std::vector<cv::Mat> parts;
  const cv::Mat gap(gap_px, page_width_px, CV_8UC3, cv::Scalar::all(255));
  parts.push_back(gap);
  for (const auto& row : rows) {
    const cv::Mat drawn = draw_row(row, page_width_px);
    if (drawn.empty()) continue;
    parts.push_back(drawn);
    parts.push_back(gap);
  }
  cv::Mat page;
  cv::vconcat(parts, page);
  return page;
}

}  // namespace hogline::drawing
