// Where the stones of a campaign came to rest.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "src/campaign/row.hpp"

namespace hogline::campaign {

/// The far house from above, down-ice upwards, with a point for each stone that lies in the picture, an ellipse of one
/// sigma about their mean, and one of elite players' about the tee.
cv::Mat resting_places(const std::vector<Row>& rows);

}  // namespace hogline::campaign
