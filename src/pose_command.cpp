#include "src/pose_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <functional>

#include "hw/files/image_file.hpp"
#include "src/config/config_error.hpp"
#include "src/config/rig.hpp"
#include "src/exit_status.hpp"
#include "src/percept_json.hpp"
#include "vision/low_sequence.hpp"
#include "vision/low_view.hpp"
#include "vision/near_view.hpp"

namespace hogline {
namespace {

using Estimator = std::function<SheetPosePercept(const cv::Mat&, Stamp)>;

Estimator estimator(const PoseOptions& options, const vision::CameraSetup& setup) {
  if (options.camera == "near") {
    return [view = std::make_shared<vision::NearView>(setup)](const cv::Mat& image, Stamp stamp) {
      return view->acquire(image, stamp);
    };
  }
  if (options.sequence) {
    return [view = std::make_shared<vision::LowSequence>(setup)](const cv::Mat& image, Stamp stamp) {
      return view->step(image, stamp);
    };
  }
  return [view = std::make_shared<vision::LowView>(setup)](const cv::Mat& image, Stamp stamp) {
    return view->acquire(image, stamp);
  };
}

void check_use(const PoseOptions& options) {
  if (options.sequence && !(options.rate_hz > 0.0 && options.rate_hz <= 1000.0)) {
    throw config::ConfigError("command line", 0, "--rate", fmt::format("{}", options.rate_hz),
                              "must be above 0, at most 1000 frames a second");
  }
  for (const std::string& image : options.images) {
    if (!std::filesystem::is_regular_file(image)) {
      throw config::ConfigError(image, 0, "", "", "no such picture; give the path of a readable JPEG or PNG file");
    }
  }
}

cv::Mat read_picture(const std::string& path) {
  hw::ImageFileResult result = hw::read_image_file(path);
  if (result.error) throw config::ConfigError(path, 0, "", "", result.error->what);
  return std::move(result.image);
}

}  // namespace

int run_pose(const PoseOptions& options) {
  check_use(options);
  const config::Rig rig = config::load_rig(options.rig);
  const Estimator estimate = estimator(options, rig.camera(options.camera));

  bool all_estimated = true;
  Stamp stamp{};
  for (const std::string& path : options.images) {
    const cv::Mat image = read_picture(path);
    const auto begin = std::chrono::steady_clock::now();
    const SheetPosePercept percept = estimate(image, stamp);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    fmt::print("{}\n", pose_line(path, percept, elapsed.count()));
    std::fflush(stdout);
    all_estimated = all_estimated && percept.ok;
    stamp += from_seconds(1.0 / options.rate_hz);
  }
  return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
