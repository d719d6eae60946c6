// One stone's picture as a mixture: the handle's face and wall, granite, and what is behind, blurred by lens and
// sensor.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/detect/known_stone.hpp"
#include "vision/fit/foreground.hpp"
#include "vision/fit/product_sums.hpp"
#include "vision/fit/stone_look.hpp"
#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

inline constexpr int model_numbers = 2 + shared_numbers;  ///< x, y before them

using ModelVector = Eigen::Matrix<double, model_numbers, 1>;
using ModelMatrix = Eigen::Matrix<double, model_numbers, model_numbers>;

class StoneModel {
 public:
  /// Gathers about `most` pixels of the outline.
  StoneModel(const StonePicture& picture, const SharedLook& look, const Eigen::Vector2d& start, int most);

  const Eigen::Vector2d& place() const { return place_; }
  double range_m() const { return (place_ - eye_.head<2>()).norm(); }
  void move(const Eigen::Vector2d& step);

  /// Covariance of the place from a doubt of the rim's height, common to all stones: it grows along the line of sight.
  Eigen::Matrix2d unknowable(double height_sigma_m) const;

  /// What the stone hides, from what is seen beside it; with the handle's colour known, its grip is left out, too.
  void look_behind(const SharedLook& look);
  /// Leaves out the pixels that a nearer stone covers, and those beside the own handle that its grip seems to cover.
  void hide_behind(const KnownStone& nearer, const SharedLook& look);

  /// Leaves out, for good, what somebody hides.
  void leave_out(const Foreground& before);

  /// What granite looks like is known from the club's other stones.
  void expect_granite(const Light& granite);

  /// The colours that explain the pixels best where the stone now is: linear least squares.
  void find_colours(const SharedLook& look);
  /// Normal equations of place and shared numbers, or of the place alone (the others' are zero), with the colours
  /// eliminated; weighs the pixels by their residuals.
  void linearise(const SharedLook& look, bool with_shared);
  /// How well it is explained where it was linearised last.
  void conclude();

  bool enough() const;                           ///< enough of it is seen to place it
  double visible() const;                        ///< share of its outline's pixels in use
  double variance() const { return variance_; }  ///< of a pixel's residual, in the units of the normal equations
  double residual() const { return residual_; }  ///< RMS, light against white ice
  double explained() const { return explained_; }
  int telling() const { return telling_; }          ///< pixels that a stone changes, and no grip may cover
  double told() const { return told_; }             ///< share of them that are as foretold
  int handle_told() const { return handle_told_; }  ///< pixels of the handle that are as foretold, grip or not
  int granite_told() const { return granite_told_; }
  const ModelMatrix& normal() const { return normal_; }
  const ModelVector& right() const { return right_; }

  Light handle_colour() const;  ///< blue, green, red against white ice
  /// The middle one of the pixels that show granite and nothing else; of few such pixels, what explains them all best.
  Light granite_colour() const;
  int granite_pixels() const;  ///< how many show granite and nothing else
  Light behind_colour() const;

 private:
  /// Shares at each pixel, for one blur, and their slopes per pixel of distance.
  struct Blurred {
    Pixels plate;    ///< of the handle's colour: face, and wall by its light
    Pixels handle;   ///< covered by the handle
    Pixels face;     ///< covered by its upper face
    Pixels body;     ///< covered by the body, of what the handle leaves
    Pixels granite;  ///< granite that is seen
    Pixels by_handle, by_face, by_body;

    void mix(const DiscDistances& handle_at, const DiscDistances& face_at, const BodyDistances& body_at, float blur_px,
             float wall_light);
  };
  /// Columns of what a part of a pixel's light depends on: three colours, then what is left unexplained, then place,
  /// shared numbers and the part's own blur, which is not the other parts'.
  static constexpr int basis_columns = 3;
  static constexpr int residual_column = 3;
  static constexpr int first_slope = 4;
  static constexpr int most_slopes = model_numbers - 1;
  struct Equations;

  StonePlace stands(const SharedLook& look) const;
  const Blurred& blurred(int part) const { return part == 0 ? fine_ : coarse_; }
  void draw(const SharedLook& look);
  void choose_pixels();
  void fill_basis(int part);
  void find_residual(int part);
  void find_slopes(int part, const SharedLook& look, bool with_shared);
  void weigh();
  void find_scale();
  void count_told(const PixelColours& change);

  PatchSource source_;
  Eigen::Vector2d place_;
  Eigen::Vector3d eye_;
  StonePixels seen_;
  PixelColours light_;   ///< brightness, red less brightness, blue less brightness
  PixelColours behind_;  ///< the same
  Pixels shade_;         ///< granite darkens downwards
  Pixels open_;          ///< 0: somebody hides it; else 1
  Pixels grip_;          ///< 1: a nearer stone's grip may cover it; else 0
  Pixels used_;          ///< 1 or 0
  Pixels weight_;
  Pixels noise_;  ///< variance that each pixel's light should have
  Pixels sizes_;  ///< of the residuals, in its deviations
  DiscDistances handle_, face_;
  BodyDistances body_;
  Blurred fine_, coarse_;  ///< for brightness, for colours
  PixelColours residuals_;
  ProductSums design_;                                 ///< of one part at a time
  Eigen::Matrix3d colours_ = Eigen::Matrix3d::Zero();  ///< rows: handle, granite, its slope; columns as light
  ModelMatrix normal_ = ModelMatrix::Zero();
  ModelVector right_ = ModelVector::Zero();
  bool coloured_ = false;
  bool drawn_ = false;  ///< distances and shares are of this place and look
  Eigen::Vector2d drawn_at_ = Eigen::Vector2d::Zero();
  SharedVector drawn_with_ = SharedVector::Zero();
  bool looked_behind_ = false;              ///< from there
  Light expected_granite_ = Light::Zero();  ///< as light_; only where granite_weight_ > 0
  double granite_weight_ = 0.0;
  double scale_ = 0.0;
  double left_ = 0.0;  ///< unexplained, weighed
  double variance_ = 0.0;
  double residual_ = 0.0;
  double explained_ = 0.0;
  int telling_ = 0;
  int handle_told_ = 0;
  int granite_told_ = 0;
  double told_ = 0.0;
};

}  // namespace hogline::vision
