// The board: the stones outlined in the picture in which they were seen, and the sheet from above.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/board.hpp"
#include "vision/geometry/sheet_camera.hpp"
#include "vision/geometry/stone_shape.hpp"

namespace hogline::drawing {

/// Handle and body of each stone as the camera sees them, in its team's colour, numbered by the distance to the tee.
cv::Mat draw_stones(const cv::Mat& picture, const vision::Board& board, const vision::SheetCamera& camera,
                    const vision::StoneShape& shape);

/// The end from above, with the shot stone ringed.
cv::Mat draw_board(const vision::Board& board, std::optional<double> sheet_width_m, int length_px);

}  // namespace hogline::drawing
