// A place on the ice. Frame s unless its user says otherwise.
#pragma once

namespace hogline::servo {

struct Place {
  double x_m = 0.0;
  double y_m = 0.0;
};

}  // namespace hogline::servo
