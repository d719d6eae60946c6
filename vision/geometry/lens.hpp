// A camera's lens: from rays to pixels and back. Pixel centres are at integer coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace hogline::vision {

enum class LensModel {
  brown_conrady,   ///< radial k1 k2 k3 and tangential p1 p2 (Brown 1971), OpenCV's order k1 k2 p1 p2 k3
  kannala_brandt,  ///< equidistant with k1..k4 on odd powers of the angle (Kannala and Brandt 2006)
};

struct Intrinsics {
  int width_px = 0;
  int height_px = 0;
  LensModel model = LensModel::brown_conrady;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 5> distortion{};  ///< the fifth is unused by kannala_brandt
};

/// Both directions agree to 1e-9 px. Outside the range in which the model is one-to-one nothing is returned: a
/// polynomial that folds back would otherwise put points from behind the picture's edge into the picture.
class Lens {
 public:
  using Jacobian = Eigen::Matrix<double, 2, 3>;

  /// Precondition: positive focal lengths and size, everything finite.
  explicit Lens(const Intrinsics& intrinsics);

  const Intrinsics& intrinsics() const { return intrinsics_; }

  /// The pixel of a point in c (metres; only its direction counts), and d(pixel)/d(point) where asked for. Nothing for
  /// a point behind the camera or outside the lens model's range; the pixel may lie outside the picture.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& cP, Jacobian* jacobian = nullptr) const;

  /// The ray through a pixel, in c with z = 1 (Brown-Conrady) or of unit length (Kannala-Brandt).
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;

  /// The pixel lies in the picture, at least `margin_px` from its border.
  bool in_picture(const Eigen::Vector2d& pixel, double margin_px = 0.0) const;

 private:
  std::optional<Eigen::Vector2d> project_brown_conrady(const Eigen::Vector3d& cP, Jacobian* jacobian) const;
  std::optional<Eigen::Vector2d> project_kannala_brandt(const Eigen::Vector3d& cP, Jacobian* jacobian) const;
  std::optional<Eigen::Vector3d> ray_brown_conrady(const Eigen::Vector2d& normalised) const;
  std::optional<Eigen::Vector3d> ray_kannala_brandt(const Eigen::Vector2d& normalised) const;

  Intrinsics intrinsics_;
  double max_radius_;  ///< tan(angle) for brown_conrady, angle for kannala_brandt: one-to-one below it
};

}  // namespace hogline::vision
