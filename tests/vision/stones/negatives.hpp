// Sheets without a stone on which something looks like one.
#pragma once

#include <cstdint>

#include "tests/support/random_board.hpp"

namespace hogline::vision::testing {

/// The same seed gives the same sheet, colours and camera.
hogline::testing::RandomBoard people_in_grey(std::uint64_t seed);  ///< trousers like granite under red jackets
/// Grey under red, painted so that the camera sees body and handle where a stone's would be.
hogline::testing::RandomBoard painted_stones(std::uint64_t seed);
hogline::testing::RandomBoard handle_coloured_logos(std::uint64_t seed);
hogline::testing::RandomBoard brooms(std::uint64_t seed);

}  // namespace hogline::vision::testing
