// A straight line of paint. Read by C++17 and C++20 alike.
#pragma once

#include <Eigen/Core>
#include <string>

namespace hogline::vision::plain {

/// In e, on z = 0.
struct PaintedLine {
  std::string name;
  Eigen::Vector2d begin;
  Eigen::Vector2d end;
};

}  // namespace hogline::vision::plain
