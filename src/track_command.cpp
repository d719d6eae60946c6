#include "src/track_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "hw/files/image_file.hpp"
#include "servo/skip_sheet.hpp"
#include "src/config/config_error.hpp"
#include "src/exit_status.hpp"
#include "src/output/output_file.hpp"
#include "src/output/output_folder.hpp"
#include "src/skip/ice_file.hpp"
#include "src/skip/skip_report.hpp"
#include "src/skip/skip_vision.hpp"
#include "src/skip/track_recording.hpp"
#include "src/stones_setup.hpp"
#include "src/throw_request.hpp"

namespace hogline {
namespace {

std::optional<PlanarPose> body_at(const std::string& text) {
  if (text.empty()) return std::nullopt;
  PlanarPose body;
  double yaw_deg = 0.0;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &body.x_m, &body.y_m, &yaw_deg, &rest);
  if (read != 3 || !std::isfinite(body.x_m + body.y_m + yaw_deg)) {
    throw config::ConfigError("command line", 0, "--at", text, "must be X_M,Y_M,YAW_DEG, three numbers");
  }
  body.yaw_rad = yaw_deg * std::numbers::pi / 180.0;
  return body;
}

FrameLoader loader(const config::Rig& rig) {
  const auto& k = rig.camera("near").intrinsics;
  return [size = cv::Size(k.width_px, k.height_px)](const hw::files::RecordedFrame& f) {
    const hw::files::LoadedImage loaded = hw::files::load_image(f.path, size);
    if (loaded.error) fmt::print(stderr, "{}\n", loaded.error->what);
    hw::Frame frame;
    frame.bgr = loaded.bgr;
    return frame;
  };
}

}  // namespace

int run_track(const TrackOptions& options) {
  const OutputFolder folder("--out", options.out);
  const config::SkipRig rig = config::load_skip_rig(options.rig);
  const SkipRecording recording = read_skip_recording(options.folder);
  servo::SkipConfig config = rig.skip;
  config.known_body = body_at(options.at);
  config.expected_spin_radps = options.spin_radps;
  servo::IceEstimate ice = servo::IceModel(servo::IceModelConfig{}).estimate();
  if (!options.ice.empty()) check_file("--ice", options.ice);
  if (!options.ice.empty()) ice = load_ice(options.ice).value_or(ice);

  SkipVision seer(rig);
  const TrackedThrow tracked = track_recording(recording, config, ice, seer, loader(rig.rig));

  servo::IceModel model(servo::IceModelConfig{}, ice);
  if (tracked.report.result.track) model.learn(servo::from_other_end(*tracked.report.result.track));
  if (!options.ice.empty() && tracked.report.result.track) save_ice(options.ice, model.estimate());
  ToldThrow told;
  told.report = &tracked.report;
  told.known = &tracked.known;
  told.origin = tracked.origin;
  told.ice = model.estimate();
  told.foretold = tracked.foretold;
  told.teams = team_names(rig.rig);
  told.seen_by = "vision";
  told.unread = tracked.unread;
  write_throw(options.out, told);
  fmt::print("{}\n", throw_json(told, -1));
  return tracked.report.ok ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
