// What a campaign looks like.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "src/campaign/row.hpp"

namespace hogline::campaign {

/// The distribution of each measure, under each other.
cv::Mat distributions(const std::vector<Row>& rows);

}  // namespace hogline::campaign
