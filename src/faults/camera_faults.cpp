// What can happen to the cameras: the low one in the run, the near one before it.
#include "src/faults/case_words.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using Fault = hw::sim::RenderedCamera::Fault;

constexpr Duration next_frame = 65ms;  // a look of 40 ms, a frame and a control period

Action low(Fault fault) {
  return [fault](Site& s) { s.robot.low_camera().inject(fault); };
}
Action near(Fault fault) {
  return [fault](Site& s) { s.robot.near_camera().inject(fault); };
}

}  // namespace

std::vector<Case> camera_faults() {
  const Action well = low(Fault::none);
  Case never = stops("no first frame", "the near camera delivers nothing from power-on", 8s, "near camera",
                     near(Fault::stopped), near(Fault::none));
  never.strike = Strike::power_on;
  return {
      never,
      with(stops("frames stop", "near camera, while the robot turns", 165ms, "near camera: timeout",
                 near(Fault::stopped), near(Fault::none)),
           Strike::aligning),
      stops("frames stop", "low camera", 205ms, "low camera: timeout: no frame", low(Fault::stopped), well),
      goes_on("one frame missing", "nothing for 20 ms", 20ms, low(Fault::stopped), well),
      goes_on("id gap", "four frames lost in a row", 70ms, low(Fault::stopped), well),
      stops("frames late", "delivered 0.12 s late", 205ms, "low camera: timeout", low(Fault::late), well),
      stops("old frames", "the last frame again, with its old stamp", next_frame, "low camera: implausible",
            low(Fault::frozen), well),
      stops("time goes back", "stamps 0.1 s earlier", next_frame, "low camera: implausible", low(Fault::time_back),
            well),
      stops("unsynchronised clock", "stamps 0.2 s ahead", next_frame, "low camera: implausible", low(Fault::ahead),
            well),
      stops("black", "cover closed", next_frame, "low camera: implausible: the picture is black", low(Fault::black),
            well),
      with(stops("black", "near camera, while the robot turns", 75ms, "near camera: implausible: the picture is black",
                 near(Fault::black), near(Fault::none)),
           Strike::aligning),
      stops("saturated", "every pixel at its end", next_frame, "low camera: implausible: the picture is saturated",
            low(Fault::saturated), well),
      stops("frozen", "one picture again and again, with new numbers and stamps", next_frame,
            "low camera: implausible: the picture is frozen", low(Fault::repeated), well),
      with(stops("frozen", "near camera, while the robot turns", 75ms,
                 "near camera: implausible: the picture is frozen", near(Fault::repeated), near(Fault::none)),
           Strike::aligning),
      with(goes_on("frames stop", "low camera, in the last metre: dead reckoning", {}, low(Fault::stopped), well),
           Strike::too_late),
  };
}

}  // namespace hogline::faults
