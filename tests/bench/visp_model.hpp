// Competitor: ViSP's model-based tracker (vpMbGenericTracker, moving edges) with the sheet's lines as its CAD model.
#pragma once

#include <memory>
#include <vector>

#include "tests/bench/method.hpp"

namespace hogline::bench {

/// As ViSP's tutorial on the generic model-based tracker does it, with what a careful user would set for this picture:
/// see the .cpp. Its circles do not work in 3.5.0 (lagadic/visp, issue 1155), so rings are left out. `model` are the
/// edges of the paint.
std::unique_ptr<Method> make_visp_model(const Camera& camera, const std::vector<PaintedLine>& model);

}  // namespace hogline::bench
