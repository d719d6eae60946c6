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
#include "vision/stone_average.hpp"

namespace hogline {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// What one picture shows.
struct Look {
  StonesPercept stones;
  vision::Pose eMc = vision::Pose::Identity();
  std::optional<double> sheet_width_m;
};

class Looker {
 public:
  explicit Looker(const vision::StonesSetup& setup) : near_view_(setup.camera), finder_(setup) {}

  Look look(const Picture& picture) {
    Look seen;
    if (picture.bgr.empty()) {
      seen.stones.reason = picture.problem;
      return seen;
    }
    const SheetPosePercept sheet = near_view_.acquire(picture.bgr, picture.stamp);
    if (!sheet.ok) {
      seen.stones.reason = "the sheet's pose: " + sheet.reason;
      return seen;
    }
    seen.eMc = vision::from_row_major(sheet.eMc);
    seen.sheet_width_m = sheet.sheet_width_m;
    seen.stones = finder_.find(picture.bgr, picture.stamp, seen.eMc, seen.sheet_width_m);
    return seen;
  }

 private:
  vision::NearView near_view_;
  vision::StoneFinder finder_;
};

/// All pictures of one robot that stands still.
struct Standing {
  vision::StoneAverage average;
  int pictures = 0;
  std::string reason;  ///< of the last picture that showed nothing
};

}  // namespace

int run_stones(const StonesOptions& options) {
  const config::Rig rig = config::load_rig(options.rig);
  const vision::StonesSetup setup = stones_setup(rig);
  std::optional<DrawingFolder> drawings;
  if (options.draw) drawings.emplace("--draw", *options.draw);
  const auto& k = setup.camera.intrinsics;
  const PictureReader next = read_pictures(options.images, {k.width_px, k.height_px}, std::nullopt);

  Looker looker(setup);
  Standing standing;
  bool all_estimated = true;
  const auto start = Clock::now();
  while (const auto picture = next()) {
    const auto begin = Clock::now();
    const Look look = looker.look(*picture);
    if (!options.sequence) {
      fmt::print("{}\n", stones_line(picture->name, look.stones, team_names(rig), ms_since(begin)));
      std::fflush(stdout);
    }
    if (drawings && look.stones.ok) {
      const vision::SheetCamera camera(vision::Lens(k), look.eMc, setup.camera.ice);
      const vision::Board board = vision::judge(look.stones.stones, look.sheet_width_m);
      drawings->save(picture->name, drawing::draw_stones(picture->bgr, board, camera, setup.shape));
    }
    ++standing.pictures;
    standing.average.add(look.stones);
    if (!look.stones.ok) standing.reason = look.stones.reason;
    all_estimated = all_estimated && look.stones.ok;
  }
  if (!options.sequence) return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
  const int frames = standing.average.frames();
  fmt::print("{}\n", stones_sequence_line(standing.pictures, frames, standing.average.stones(), standing.reason,
                                          team_names(rig), ms_since(start)));
  return frames > 0 ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
