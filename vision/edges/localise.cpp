#include "vision/edges/localise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

// The normal distribution and its density by table: 2e-6 off at most.
class Normal {
 public:
  struct At {
    float share;
    float density;
  };

  Normal() {
    for (int i = 0; i <= steps + 1; ++i) {
      const double z = -reach + i / per_unit;
      share_[static_cast<std::size_t>(i)] = static_cast<float>(0.5 * std::erfc(-z / std::numbers::sqrt2));
      density_[static_cast<std::size_t>(i)] =
          static_cast<float>(std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi));
    }
  }

  At operator()(float z) const {
    const float at = (std::clamp(z, -limit, limit) + limit) * static_cast<float>(per_unit);
    const auto i = static_cast<std::size_t>(at);
    const float t = at - static_cast<float>(i);
    return {share_[i] + t * (share_[i + 1] - share_[i]), density_[i] + t * (density_[i + 1] - density_[i])};
  }

 private:
  static constexpr double reach = 4.5;
  static constexpr float limit = 4.5F;
  static constexpr double per_unit = 128.0;
  static constexpr int steps = static_cast<int>(2.0 * reach * per_unit);
  std::array<float, steps + 2> share_{};
  std::array<float, steps + 2> density_{};
};

const Normal& normal() {
  static const Normal table;
  return table;
}

// A shape between 0 and 1 at one sample, and how it moves with place and blur.
struct ShapeAt {
  float value;
  float by_place;
  float by_blur;
};

ShapeAt step_shape(float t, float place, float blur) {
  const float z = (t - place) / blur;
  const auto n = normal()(z);
  return {n.share, -n.density / blur, -n.density * z / blur};
}

ShapeAt bar_shape(float t, float place, float blur, float width) {
  const ShapeAt rise = step_shape(t, place - 0.5F * width, blur);
  const ShapeAt fall = step_shape(t, place + 0.5F * width, blur);
  return {rise.value - fall.value, rise.by_place - fall.by_place, rise.by_blur - fall.by_blur};
}

ShapeAt shape(const EdgeExpectation& expected, float t, float place, float blur) {
  return expected.width_px > 0.0 ? bar_shape(t, place, blur, static_cast<float>(expected.width_px))
                                 : step_shape(t, place, blur);
}

struct Window {
  int begin;
  int end;
  int size() const { return end - begin; }
};

Window window_around(const Profile& profile, const EdgeExpectation& expected) {
  const double half = 0.5 * expected.width_px;
  const double first = (expected.offset_px - half - expected.before_px - profile.first_px) / profile.step_px;
  const double last = (expected.offset_px + half + expected.after_px - profile.first_px) / profile.step_px;
  return {std::max(0, static_cast<int>(std::ceil(first - 1e-6))),
          std::min(profile.count, static_cast<int>(std::floor(last + 1e-6)) + 1)};
}

// Each channel's change of light: least squares of background, slope (of a bar only) and the shape where it is
// expected.
std::array<float, 3> colour_change(const Profile& profile, const Window& window, const EdgeExpectation& expected) {
  Eigen::Matrix3f gram = Eigen::Matrix3f::Zero();
  Eigen::Matrix3f rhs = Eigen::Matrix3f::Zero();
  const auto centre = static_cast<float>(expected.offset_px);
  const bool bar = expected.width_px > 0.0;
  for (int i = window.begin; i < window.end; ++i) {
    const auto t = static_cast<float>(profile.position(i));
    const ShapeAt s = shape(expected, t, centre, static_cast<float>(expected.blur_px));
    const Eigen::Vector3f row(1.0F, bar ? t - centre : 0.0F, s.value);
    gram.noalias() += row * row.transpose();
    for (int c = 0; c < profile.channels; ++c) {
      rhs.col(c) += profile.light[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)] * row;
    }
  }
  if (!bar) gram(1, 1) = 1.0F;
  const Eigen::Matrix3f solved = gram.ldlt().solve(rhs);
  return {solved(2, 0), solved(2, 1), solved(2, 2)};
}

constexpr int parameters = 5;  // background, slope, contrast, place, blur
using Vector = Eigen::Matrix<double, parameters, 1>;
using Matrix = Eigen::Matrix<double, parameters, parameters>;

// The inverse of a symmetric positive matrix by Cholesky's factors: for five numbers three times as fast as Eigen's
// general ones. Not finite when the matrix is not positive.
Matrix inverse_of(const Matrix& a) {
  Matrix lower = Matrix::Zero();  // first the factor, then its inverse
  for (int j = 0; j < parameters; ++j) {
    double pivot = a(j, j);
    for (int k = 0; k < j; ++k) pivot -= lower(j, k) * lower(j, k);
    lower(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < parameters; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= lower(i, k) * lower(j, k);
      lower(i, j) = sum / lower(j, j);
    }
  }
  for (int j = 0; j < parameters; ++j) {
    lower(j, j) = 1.0 / lower(j, j);
    for (int i = j + 1; i < parameters; ++i) {
      double sum = 0.0;
      for (int k = j; k < i; ++k) sum -= lower(i, k) * lower(k, j);
      lower(i, j) = sum / lower(i, i);
    }
  }
  return lower.transpose().lazyProduct(lower);
}

struct Fit {
  Vector p;
  Matrix normal;
  double residual2;
};

// The shape and its derivatives at every sample of the window, one array each: their sums of products become vector
// code.
struct Columns {
  using Column = Eigen::Array<float, Profile::max_samples, 1>;
  Column shape;
  Column place;
  Column blur;
  Column along;
  Column residual;
};

float product(const Columns::Column& a, const Columns::Column& b, int n) {
  return a.head(n).matrix().dot(b.head(n).matrix());
}

// The normal equations of the joined light about the parameters.
Fit linearise(const std::array<float, Profile::max_samples>& light, const Profile& profile, const Window& window,
              const EdgeExpectation& expected, const Vector& p, Columns& at, Vector& gradient) {
  const bool bar = expected.width_px > 0.0;
  const Eigen::Matrix<float, parameters, 1> q = p.cast<float>();
  const int n = window.size();
  for (int k = 0; k < n; ++k) {
    const auto t = static_cast<float>(profile.position(window.begin + k));
    const ShapeAt s = shape(expected, t, q[3], q[4]);
    const float along = bar ? t - static_cast<float>(expected.offset_px) : 0.0F;
    at.along[k] = along;
    at.shape[k] = s.value;
    at.place[k] = q[2] * s.by_place;
    at.blur[k] = q[2] * s.by_blur;
    at.residual[k] = light[static_cast<std::size_t>(window.begin + k)] - (q[0] + q[1] * along + q[2] * s.value);
  }
  Fit fit{p, Matrix::Zero(), static_cast<double>(product(at.residual, at.residual, n))};
  const std::array<const Columns::Column*, parameters> columns{nullptr, &at.along, &at.shape, &at.place, &at.blur};
  fit.normal(0, 0) = n;
  gradient[0] = static_cast<double>(at.residual.head(n).sum());
  for (int i = 1; i < parameters; ++i) {
    const Columns::Column& column = *columns[static_cast<std::size_t>(i)];
    fit.normal(0, i) = fit.normal(i, 0) = static_cast<double>(column.head(n).sum());
    gradient[i] = static_cast<double>(product(column, at.residual, n));
    for (int j = 1; j <= i; ++j) {
      const Columns::Column& other = *columns[static_cast<std::size_t>(j)];
      fit.normal(i, j) = fit.normal(j, i) = static_cast<double>(product(column, other, n));
    }
  }
  if (!bar) fit.normal(1, 1) = 1.0;
  return fit;
}

constexpr double significant = 4.5;  // sigmas of the contrast
constexpr double least_blur_px = 0.35;
constexpr double most_blur_px = 12.0;

// Least squares by Levenberg and Marquardt; the blur is held within its range.
Fit solve(const std::array<float, Profile::max_samples>& light, const Profile& profile, const Window& window,
          const EdgeExpectation& expected, Vector start) {
  constexpr int max_iterations = 8;
  Columns columns;
  Vector gradient;
  Fit best = linearise(light, profile, window, expected, start, columns, gradient);
  double damping = 1e-3;
  for (int i = 0; i < max_iterations; ++i) {
    Matrix damped = best.normal;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    Vector step = inverse_of(damped) * gradient;
    if (!step.allFinite()) break;
    const double limit = std::max(1.0, expected.blur_px);
    if (std::abs(step[3]) > limit) step *= limit / std::abs(step[3]);
    Vector next = best.p + step;
    next[4] = std::clamp(next[4], least_blur_px, most_blur_px);
    Vector next_gradient;
    const Fit tried = linearise(light, profile, window, expected, next, columns, next_gradient);
    if (tried.residual2 <= best.residual2) {
      best = tried;
      gradient = next_gradient;
      damping *= 0.2;
    } else {
      damping = std::max(10.0 * damping, 1e-2);
      continue;
    }
    // The next step would be a tenth of this one at most.
    if (std::abs(step[3]) < 4e-3 && std::abs(step[4]) < 3e-2) break;
  }
  return best;
}

// A sensor with one colour a pixel has red and blue at every fourth pixel only: interpolated, they beat with what is
// thinner than two pixels (measured: 0.2 px on a line, three times green's). Green leads where it tells anything.
std::array<float, 3> channel_weights(const std::array<float, 3>& colour) {
  constexpr std::array<float, 3> trusted{0.5F, 1.0F, 0.5F};
  std::array<float, 3> weight{};
  float square = 0.0F;
  for (std::size_t c = 0; c < 3; ++c) {
    weight[c] = trusted[c] * colour[c];
    square += weight[c] * weight[c];
  }
  const float size = std::sqrt(square);
  for (float& w : weight) w /= size;
  return weight;
}

LocalEdge failed(EdgeFault fault) {
  LocalEdge edge;
  edge.fault = fault;
  return edge;
}

}  // namespace

LocalEdge locate(const Profile& profile, const EdgeExpectation& expected) {
  const Window window = window_around(profile, expected);
  if (window.size() < 7) return failed(EdgeFault::too_short);

  const std::array<float, 3> change = colour_change(profile, window, expected);
  const float size = std::sqrt(change[0] * change[0] + change[1] * change[1] + change[2] * change[2]);
  if (!(size > 0.004F)) return failed(EdgeFault::no_contrast);
  LocalEdge edge;
  for (std::size_t c = 0; c < 3; ++c) edge.colour[c] = change[c] / size;

  const std::array<float, 3> weight = channel_weights(edge.colour);
  const float joined = weight[0] * change[0] + weight[1] * change[1] + weight[2] * change[2];

  std::array<float, Profile::max_samples> light{};
  for (int i = window.begin; i < window.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (std::size_t c = 0; c < static_cast<std::size_t>(profile.channels); ++c) {
      light[k] += weight[c] * profile.light[c][k];
    }
  }
  Vector start;
  const bool bar = expected.width_px > 0.0;
  const auto first = static_cast<std::size_t>(window.begin);
  const auto last = static_cast<std::size_t>(window.end - 1);
  const double base = static_cast<double>(bar ? 0.5F * (light[first] + light[last]) : light[first]);
  start << base, 0.0, static_cast<double>(joined), expected.offset_px, expected.blur_px;
  const Fit fit = solve(light, profile, window, expected, start);

  const int freedom = std::max(1, window.size() - (bar ? 5 : 4));
  const double noise = std::sqrt(fit.residual2 / freedom);
  // Samples closer than a pixel share their pixels' noise.
  const double shared = 1.0 / std::min(profile.step_px, 1.0);
  const Matrix regular = fit.normal + 1e-12 * Matrix::Identity();
  const Matrix inverse = shared * inverse_of(regular);
  edge.offset_px = fit.p[3];
  edge.contrast = fit.p[2];
  edge.blur_px = fit.p[4];
  edge.sigma_px = noise * std::sqrt(std::max(0.0, inverse(3, 3)));
  if (!std::isfinite(edge.offset_px) || !std::isfinite(edge.sigma_px)) return failed(EdgeFault::no_contrast);
  if (std::abs(edge.offset_px - expected.offset_px) > expected.max_shift_px) return failed(EdgeFault::left_window);
  if (!(edge.contrast > significant * noise * std::sqrt(std::max(0.0, inverse(2, 2))) && edge.contrast > 0.006)) {
    return failed(EdgeFault::no_contrast);
  }
  if (noise > 0.5 * edge.contrast) return failed(EdgeFault::not_like_that);
  edge.contrast *= static_cast<double>(size / joined);  // along `colour`
  edge.fault = EdgeFault::none;
  return edge;
}

}  // namespace hogline::vision
