#include "src/board_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "src/drawing/board_picture.hpp"
#include "src/drawing/contact_sheet.hpp"
#include "src/drawing_file.hpp"
#include "src/exit_status.hpp"
#include "src/percept_json.hpp"
#include "src/picture_reader.hpp"
#include "src/standing_still.hpp"
#include "src/stones_setup.hpp"
#include "vision/board.hpp"
#include "vision/near_view.hpp"
#include "vision/stone_average.hpp"

namespace hogline {
namespace {

/// What the pictures say together.
struct Looks {
  vision::StoneAverage average;
  cv::Mat last;
  SheetPosePercept sheet;  ///< of the last picture in which it was seen
  std::string refused;     ///< why the pictures say nothing together
};

Looks look_at_all(const BoardOptions& options, const vision::StonesSetup& setup) {
  vision::NearView near_view(setup.camera);
  vision::StoneFinder finder(setup);
  Looks looks;
  StandingStill still;
  const auto& k = setup.camera.intrinsics;
  const PictureReader next = read_pictures(options.images, {k.width_px, k.height_px}, std::nullopt);
  while (const auto picture = next()) {
    if (picture->bgr.empty()) {
      fmt::print(stderr, "{}: {}\n", picture->name, picture->problem);
      continue;
    }
    const SheetPosePercept sheet = near_view.acquire(picture->bgr, {});
    if (!sheet.ok) {
      fmt::print(stderr, "{}: the sheet's pose: {}\n", picture->name, sheet.reason);
      continue;
    }
    looks.refused = still.contradiction(picture->name, sheet);
    if (!looks.refused.empty()) return looks;
    looks.average.add(finder.find(picture->bgr, {}, vision::from_row_major(sheet.eMc), sheet.sheet_width_m));
    looks.last = picture->bgr;
    looks.sheet = sheet;
  }
  return looks;
}

std::string remarks(const vision::RuledStone& s) {
  std::string all;
  const auto add = [&all](const std::string& word) { all += (all.empty() ? "" : ", ") + word; };
  if (s.in_house) add("in the house");
  if (!s.in_play) add(s.hogged ? "hogged" : "out of play");
  for (const std::string& line : s.touches) add("touches " + line);
  if (!s.certain) add("too near to call");
  return all;
}

// In degrees, modulo half a turn; nothing where it is not seen.
std::string handle_text(const StoneSighting& s) {
  return s.handle_rad ? fmt::format("{:.1f}", *s.handle_rad * 180.0 / std::numbers::pi) : std::string();
}

void tell(const vision::Board& board, int frames, const TeamNames& names) {
  const auto counted = [](std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  fmt::print("{} in {}\n", counted(board.stones.size(), "stone"), counted(static_cast<std::size_t>(frames), "picture"));
  fmt::print("{:>3} {:<8} {:>8} {:>8} {:>8} {:>9} {:>12}\n", "", "team", "x / m", "y / m", "tee / m", "sigma / m",
             "handle / deg");
  for (const vision::RuledStone& s : board.stones) {
    const double sigma_m = std::sqrt(std::max(s.seen.covariance.xx_m2, s.seen.covariance.yy_m2));
    fmt::print("{:>3} {:<8} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.3f} {:>12}  {}\n",
               s.order > 0 ? std::to_string(s.order) : "", team_name(s.seen.team, names), s.seen.x_m, s.seen.y_m,
               s.tee_distance_m, sigma_m, handle_text(s.seen), remarks(s));
  }
  if (!board.shot) {
    fmt::print("no stone in the house\n");
    return;
  }
  fmt::print("shot stone: {}{}, lying {}\n", team_name(board.scoring, names),
             board.shot_certain ? "" : " (too near to call)", board.score);
}

void draw(DrawingFolder& drawings, const vision::StonesSetup& setup, const vision::Board& board, const Looks& looks) {
  const vision::SheetCamera camera(vision::Lens(setup.camera.intrinsics), vision::from_row_major(looks.sheet.eMc),
                                   setup.camera.ice);
  const cv::Mat page =
      drawing::draw_contact_sheet({{{drawing::draw_stones(looks.last, board, camera, setup.shape), "what was seen"},
                                    {drawing::draw_board(board, looks.sheet.sheet_width_m, 1200), "from above"}}},
                                  1800);
  fmt::print(stderr, "drawing: {}\n", drawings.save("board", page));
}

}  // namespace

int run_board(const BoardOptions& options) {
  const config::Rig rig = config::load_rig(options.rig);
  const vision::StonesSetup setup = stones_setup(rig);
  std::optional<DrawingFolder> drawings;
  if (options.out) drawings.emplace("--out", *options.out);
  const Looks looks = look_at_all(options, setup);
  if (!looks.refused.empty()) {
    fmt::print(stderr, "these pictures are {}\n", looks.refused);
    return ExitStatus::not_achieved;
  }
  if (looks.average.frames() == 0) {
    fmt::print("nothing seen\n");
    return ExitStatus::not_achieved;
  }
  const vision::Board board = vision::judge(looks.average.stones(), looks.sheet.sheet_width_m);
  tell(board, looks.average.frames(), team_names(rig));
  if (drawings) draw(*drawings, setup, board, looks);
  return ExitStatus::success;
}

}  // namespace hogline
