#include "src/stones_command.hpp"

#include <fmt/format.h>

#include <chrono>

#include "src/config/rig.hpp"
#include "src/exit_status.hpp"
#include "src/percept_json.hpp"
#include "src/pictures.hpp"
#include "vision/near_view.hpp"
#include "vision/stones.hpp"

namespace hogline {
namespace {

vision::StonesSetup stones_setup(const config::Rig& rig) {
  vision::StonesSetup setup;
  setup.camera = rig.camera("near");
  setup.shape.handle_radius_m = rig.stone.radius_m;
  setup.shape.handle_height_m = rig.stone.height_m;
  return setup;
}

StonesPercept not_seen(const std::string& reason) {
  StonesPercept percept;
  percept.reason = reason;
  return percept;
}

}  // namespace

int run_stones(const StonesOptions& options) {
  check_pictures_exist(options.images);
  const config::Rig rig = config::load_rig(options.rig);
  const vision::StonesSetup setup = stones_setup(rig);
  vision::NearView near_view(setup.camera);
  vision::StoneFinder finder(setup);

  bool all_estimated = true;
  for (const std::string& path : options.images) {
    const hw::files::LoadedImage image = read_picture(path, setup.camera.intrinsics);
    const auto begin = std::chrono::steady_clock::now();
    StonesPercept percept;
    if (image.error) {
      percept = not_seen(image.error->what);
    } else {
      const SheetPosePercept sheet = near_view.acquire(image.bgr, {});
      percept = sheet.ok ? finder.find(image.bgr, {}, vision::from_row_major(sheet.eMc), sheet.sheet_width_m)
                         : not_seen("the sheet's pose: " + sheet.reason);
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    fmt::print("{}\n", stones_line(path, percept, elapsed.count()));
    std::fflush(stdout);
    all_estimated = all_estimated && percept.ok;
  }
  return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
