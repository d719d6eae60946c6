// Central differences: what every Jacobian is checked against.
#pragma once

#include <Eigen/Core>

namespace hogline::vision::testing {

template <int Rows, int Cols, typename Function>
Eigen::Matrix<double, Rows, Cols> numerical_derivative(const Function& f, const Eigen::Matrix<double, Cols, 1>& at,
                                                       double step = 1e-5) {
  Eigen::Matrix<double, Rows, Cols> jacobian;
  for (int i = 0; i < Cols; ++i) {
    Eigen::Matrix<double, Cols, 1> delta = Eigen::Matrix<double, Cols, 1>::Zero();
    delta(i) = step;
    jacobian.col(i) = (f(at + delta) - f(at - delta)) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace hogline::vision::testing
