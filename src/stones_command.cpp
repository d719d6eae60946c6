#include "src/stones_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "src/drawing/board_picture.hpp"
#include "src/drawing_file.hpp"
#include "src/exit_status.hpp"
#include "src/percept_json.hpp"
#include "src/picture_reader.hpp"
#include "src/stones_setup.hpp"
#include "vision/board.hpp"
#include "vision/near_view.hpp"

namespace hogline {
namespace {

StonesPercept not_seen(const std::string& reason) {
  StonesPercept percept;
  percept.reason = reason;
  return percept;
}

}  // namespace

int run_stones(const StonesOptions& options) {
  const config::Rig rig = config::load_rig(options.rig);
  const vision::StonesSetup setup = stones_setup(rig);
  vision::NearView near_view(setup.camera);
  vision::StoneFinder finder(setup);
  const vision::Lens lens(setup.camera.intrinsics);

  const auto& k = setup.camera.intrinsics;
  const PictureReader next = read_pictures(options.images, {k.width_px, k.height_px}, std::nullopt);

  bool all_estimated = true;
  while (const auto picture = next()) {
    const auto begin = std::chrono::steady_clock::now();
    StonesPercept percept;
    vision::Pose eMc = vision::Pose::Identity();
    std::optional<double> width_m;
    if (picture->bgr.empty()) {
      percept = not_seen(picture->problem);
    } else {
      const SheetPosePercept sheet = near_view.acquire(picture->bgr, {});
      if (sheet.ok) eMc = vision::from_row_major(sheet.eMc);
      width_m = sheet.sheet_width_m;
      percept = sheet.ok ? finder.find(picture->bgr, {}, eMc, width_m) : not_seen("the sheet's pose: " + sheet.reason);
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    fmt::print("{}\n", stones_line(picture->name, percept, elapsed.count()));
    std::fflush(stdout);
    if (!options.draw.empty() && percept.ok) {
      const vision::SheetCamera camera(lens, eMc, setup.camera.ice);
      save_drawing(options.draw, picture->name,
                   drawing::draw_stones(picture->bgr, vision::judge(percept.stones, width_m), camera, setup.shape));
    }
    all_estimated = all_estimated && percept.ok;
  }
  return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
