#include "src/pose_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "src/config/config_error.hpp"
#include "src/config/rig.hpp"
#include "src/drawing/picture_overlay.hpp"
#include "src/drawing_file.hpp"
#include "src/exit_status.hpp"
#include "src/percept_json.hpp"
#include "src/picture_reader.hpp"
#include "vision/low_sequence.hpp"
#include "vision/low_view.hpp"
#include "vision/near_sequence.hpp"
#include "vision/near_view.hpp"

namespace hogline {
namespace {

// Estimates one picture; draws what was seen into `drawing` where that is not null.
using Estimator = std::function<SheetPosePercept(const cv::Mat& image, Stamp stamp, cv::Mat* drawing)>;

Estimator near_estimator(const vision::CameraSetup& setup) {
  return [view = std::make_shared<vision::NearView>(setup)](const cv::Mat& image, Stamp stamp, cv::Mat* drawing) {
    if (drawing == nullptr) return view->acquire(image, stamp);
    vision::NearViewSketch sketch;
    const SheetPosePercept percept = view->acquire(image, stamp, &sketch);
    *drawing = drawing::draw_near_view(image, percept, sketch);
    return percept;
  };
}

Estimator low_estimator(const vision::CameraSetup& setup) {
  return [view = std::make_shared<vision::LowView>(setup)](const cv::Mat& image, Stamp stamp, cv::Mat* drawing) {
    if (drawing == nullptr) return view->acquire(image, stamp);
    vision::LowViewSketch sketch;
    const SheetPosePercept percept = view->acquire(image, stamp, {}, &sketch);
    *drawing = drawing::draw_low_view(image, percept, sketch);
    return percept;
  };
}

Estimator near_sequence_estimator(const vision::CameraSetup& setup) {
  return [view = std::make_shared<vision::NearSequence>(setup)](const cv::Mat& image, Stamp stamp, cv::Mat* drawing) {
    if (drawing == nullptr) return view->step(image, stamp);
    vision::NearViewSketch sketch;
    const SheetPosePercept percept = view->step(image, stamp, std::nullopt, &sketch);
    *drawing = drawing::draw_near_view(image, percept, sketch);
    return percept;
  };
}

Estimator low_sequence_estimator(const vision::CameraSetup& setup) {
  return [view = std::make_shared<vision::LowSequence>(setup)](const cv::Mat& image, Stamp stamp, cv::Mat* drawing) {
    const SheetPosePercept percept = view->step(image, stamp);
    if (drawing != nullptr) *drawing = drawing::draw_low_view(image, percept, {});
    return percept;
  };
}

Estimator estimator(const PoseOptions& options, const vision::CameraSetup& setup) {
  if (options.camera == "near") return options.sequence ? near_sequence_estimator(setup) : near_estimator(setup);
  return options.sequence ? low_sequence_estimator(setup) : low_estimator(setup);
}

void check_use(const PoseOptions& options) {
  if (options.rate_hz && !(*options.rate_hz >= 0.1 && *options.rate_hz <= 1000.0)) {
    throw config::ConfigError("command line", 0, "--rate", fmt::format("{}", *options.rate_hz),
                              "must be from 0.1 to 1000 frames a second");
  }
}

SheetPosePercept not_seen(const std::string& reason, Stamp stamp) {
  SheetPosePercept percept;
  percept.stamp = stamp;
  percept.reason = reason;
  return percept;
}

}  // namespace

int run_pose(const PoseOptions& options) {
  check_use(options);
  std::optional<DrawingFolder> drawings;
  if (options.draw) drawings.emplace("--draw", *options.draw);
  const config::Rig rig = config::load_rig(options.rig);
  const vision::CameraSetup& setup = rig.camera(options.camera);
  const PictureReader next =
      read_pictures(options.images, {setup.intrinsics.width_px, setup.intrinsics.height_px}, options.rate_hz);
  const Estimator estimate = estimator(options, setup);

  bool all_estimated = true;
  while (const auto picture = next()) {
    cv::Mat drawing;
    const auto begin = std::chrono::steady_clock::now();
    const SheetPosePercept percept = picture->bgr.empty()
                                         ? not_seen(picture->problem, picture->stamp)
                                         : estimate(picture->bgr, picture->stamp, drawings ? &drawing : nullptr);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    fmt::print("{}\n", pose_line(picture->name, percept, elapsed.count()));
    std::fflush(stdout);
    if (!drawing.empty()) drawings->save(picture->name, drawing);
    all_estimated = all_estimated && percept.ok;
  }
  return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
