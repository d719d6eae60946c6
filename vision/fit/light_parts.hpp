// Light parted into brightness, which sensors see sharply, and two colours, which they blur and share.
#pragma once

#include "vision/fit/stone_patch.hpp"

namespace hogline::vision {

/// Neighbouring pixels share their colours: so much less they count.
inline constexpr float colour_weight = 0.4F;

/// Brightness, red less brightness, blue less brightness (zero for grey), of blue, green, red.
PixelColours in_parts(const PixelColours& light);

/// The same of one colour.
Light parts_of(const Light& bgr);

/// How much of a colour is in what is seen, whatever grey is mixed with it: 0..1. Both as parts; 0 where `wanted` is
/// grey.
double likeness(const Light& seen, const Light& wanted);

/// Blue, green, red of the parts.
Light from_parts(const Light& parts);

}  // namespace hogline::vision
