// One stone's picture as a mixture: the handle's face and wall, granite, and what is behind, blurred by lens and
// sensor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

/// What all stones of a picture share, beside the rig's measures of the handle.
struct SharedLook {
  StoneShape shape;
  double wall_light = 0.7;      ///< of the handle's wall, as a share of its upper face's
  double blur_px = 0.75;        ///< standard deviation, of the light as a whole
  double colour_blur_px = 1.2;  ///< of colours: sensors with a mosaic and compression blur them more
};

inline constexpr int shared_numbers =
    8;  ///< thickness, body radius, body half height, height, radius, wall, blur, colour blur
inline constexpr int model_numbers = 2 + shared_numbers;  ///< x, y before them

using ModelVector = Eigen::Matrix<double, model_numbers, 1>;
using ModelMatrix = Eigen::Matrix<double, model_numbers, model_numbers>;
using SharedVector = Eigen::Matrix<double, shared_numbers, 1>;
using SharedMatrix = Eigen::Matrix<double, shared_numbers, shared_numbers>;

SharedVector numbers_of(const SharedLook& look);
SharedLook look_of(const SharedVector& numbers);

/// A stone that may hide parts of another.
struct NearerStone {
  Eigen::Vector2d place;
  Light handle = Light::Zero();  ///< its colour against white ice
};

class StoneModel {
 public:
  /// Gathers about `most` pixels of the outline. `source` is kept.
  StoneModel(const PatchSource& source, const SheetCamera& camera, const StoneShape& shape,
             const Eigen::Vector2d& start, std::size_t most);

  const Eigen::Vector2d& place() const { return place_; }
  double range_m() const { return (place_ - eye_.head<2>()).norm(); }
  void move(const Eigen::Vector2d& step);

  /// Covariance of the place from a doubt of the rim's height, common to all stones: it grows along the line of sight.
  Eigen::Matrix2d unknowable(double height_sigma_m) const;

  /// What the stone hides, from what is seen beside it; with the handle's colour known, its grip is left out, too.
  void look_behind(const SharedLook& look);
  /// Leaves out the pixels that a nearer stone covers, and those beside the own handle that its grip seems to cover.
  void hide_behind(const NearerStone& nearer, const SharedLook& look);

  /// The colours that explain the pixels best where the stone now is: linear least squares.
  void find_colours(const SharedLook& look);
  /// Normal equations of place and shared numbers with the colours eliminated; weighs the pixels by their residuals.
  void linearise(const SharedLook& look);

  bool enough() const;                           ///< enough of it is seen to place it
  double visible() const;                        ///< share of its outline's pixels in use
  double variance() const { return variance_; }  ///< of a pixel's residual, in the units of the normal equations
  double residual() const { return residual_; }  ///< RMS, light against white ice
  double explained() const { return explained_; }
  const ModelMatrix& normal() const { return normal_; }
  const ModelVector& right() const { return right_; }

  Light handle_colour() const;  ///< blue, green, red against white ice
  Light granite_colour() const;
  Light behind_colour() const;

 private:
  /// Shares and their derivatives at one pixel, for one blur.
  struct Blurred {
    double plate = 0.0;                                    ///< of the handle's colour: face, and wall by its light
    double handle = 0.0;                                   ///< covered by the handle
    double face = 0.0;                                     ///< covered by its upper face
    double body = 0.0;                                     ///< covered by the body, of what the handle leaves
    double by_handle = 0.0, by_face = 0.0, by_body = 0.0;  ///< per pixel of distance
    double handle_by_blur = 0.0, face_by_blur = 0.0, body_by_blur = 0.0;
  };
  struct Pixel {
    Light light;  ///< brightness, red less brightness, blue less brightness
    Light behind;
    bool used = false;
    double weight = 1.0;
    double shade = 0.0;
    RegionDistance handle, face, body;
    Blurred fine, coarse;  ///< for brightness, for colours
  };

  void mix(const SharedLook& look);

  PatchSource source_;
  Eigen::Vector2d place_;
  Eigen::Vector3d eye_;
  std::vector<StonePixel> raw_;
  std::vector<Pixel> pixels_;
  Eigen::Matrix3d colours_ = Eigen::Matrix3d::Zero();  ///< rows: handle, granite, its slope; columns as light
  ModelMatrix normal_ = ModelMatrix::Zero();
  ModelVector right_ = ModelVector::Zero();
  bool coloured_ = false;
  double scale_ = 0.0;
  double variance_ = 0.0;
  double residual_ = 0.0;
  double explained_ = 0.0;
  std::size_t used_ = 0;
};

}  // namespace hogline::vision
