// The pixels that a stone's grip may cover, and what they show against what would be there without one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/detect/stone_picture.hpp"
#include "vision/fit/grip_model.hpp"
#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

/// A grip of the handle's light in place of what is behind changes each pixel's light; all that a misfit needs of it
/// are products of three differences: what is seen, the handle's light, what is behind. What is behind may be one of
/// two colours, seen beside the grip: what lies between these is left out of all products.
struct GripEvidence {
  GripSights sights;
  Pixels weight;  ///< 0 where nothing can be told
  Pixels seen_seen, seen_handle, seen_behind, handle_handle, handle_behind, behind_behind;
  double used = 0.0;     ///< pixels of some weight
  double visible = 0.0;  ///< their share of all that were looked at

  /// The light of what stands upright, as a share of the plate's, that fits best with a grip that covers so much; near
  /// `expected`.
  float wall_light(const GripCover& cover, float expected, float sigma, float variance) const;

  /// How much of a grip that covers so much is in the picture: 1 where it is as foretold, 0 where there is none; and
  /// its standard deviation for pixels of variance 1.
  struct Presence {
    float share = 0.0F;
    float sigma = 0.0F;
  };
  Presence presence(const GripCover& cover, float wall_light) const;

  /// How much of the misfit lies in few pixels: its mean as a multiple of its median. Noise makes about two.
  double lumpiness(const GripCover& cover, float wall_light) const;

  /// Weighed square of what is left unexplained by a grip that covers so much, or by none.
  float misfit(const GripCover& cover, float wall_light) const { return misfits(cover, wall_light).sum(); }
  float misfit_of_none() const { return (weight * seen_seen).sum(); }

 private:
  Pixels misfits(const GripCover& cover, float wall_light) const;
};

/// `handle` is the plate's light against white ice. Pixels that one of the `others`' stones covers are left out.
/// Nothing is used where the grip may reach out of the picture.
GripEvidence grip_evidence(const StonePicture& picture, const GripShape& shape, const Eigen::Vector2d& place,
                           const Light& handle, const std::vector<Eigen::Vector2d>& others);

}  // namespace hogline::vision
