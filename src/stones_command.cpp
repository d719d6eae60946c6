#include "src/stones_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "src/config/config_error.hpp"
#include "src/drawing/board_picture.hpp"
#include "src/drawing_file.hpp"
#include "src/exit_status.hpp"
#include "src/far_looker.hpp"
#include "src/percept_json.hpp"
#include "src/picture_reader.hpp"
#include "src/standing_still.hpp"
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
  std::optional<FarPercept> far;  ///< of the far camera, in the place of `stones`
  vision::Pose eMc = vision::Pose::Identity();
  std::optional<double> sheet_width_m;
  std::optional<SheetPosePercept> sheet;  ///< as the near camera sees it

  bool ok() const { return far ? far->ok : stones.ok; }
  const std::vector<StoneSighting>& seen() const { return far ? far->stones : stones.stones; }
};

/// Of a picture that could be read.
using Looker = std::function<Look(const Picture&)>;

Looker near_looker(const vision::StonesSetup& setup) {
  struct Eyes {
    vision::NearView near_view;
    vision::StoneFinder finder;
  };
  const auto eyes = std::make_shared<Eyes>(vision::NearView(setup.camera), vision::StoneFinder(setup));
  return [eyes](const Picture& picture) {
    Look look;
    const SheetPosePercept sheet = eyes->near_view.acquire(picture.bgr, picture.stamp);
    if (!sheet.ok) {
      look.stones.reason = "the sheet's pose: " + sheet.reason;
      return look;
    }
    look.eMc = vision::from_row_major(sheet.eMc);
    look.sheet_width_m = sheet.sheet_width_m;
    look.sheet = sheet;
    look.stones = eyes->finder.find(picture.bgr, picture.stamp, look.eMc, look.sheet_width_m);
    return look;
  };
}

Looker far_looker(const vision::FarSetup& setup, const vision::FarPlan& plan) {
  const auto eyes = std::make_shared<vision::FarView>(setup);
  return [eyes, plan](const Picture& picture) {
    Look look;
    look.far = eyes->look(picture.bgr, picture.stamp, plan);
    if (look.far->ok) look.eMc = vision::from_row_major(look.far->eMc);
    return look;
  };
}

/// The one that the options ask for, and the camera it looks through.
struct Eyes {
  vision::CameraSetup camera;
  vision::StoneShape shape;
  Looker look;
};

Eyes eyes_for(const StonesOptions& options, const config::Rig& rig) {
  if (options.camera == "far") {
    if (!options.at) {
      throw config::ConfigError("command line", 0, "--at", "",
                                "is missing: the far camera can not tell where the body stands; give its pose from the "
                                "near view as X_M,Y_M,YAW_DEG");
    }
    if (options.sequence) {
      throw config::ConfigError("command line", 0, "--sequence", "",
                                "is for the near camera: it averages stones that lie still");
    }
    const vision::FarSetup setup = far_setup(rig);
    return {setup.camera, setup.shape, far_looker(setup, far_plan(setup.camera, parse_at(*options.at)))};
  }
  if (options.at) {
    throw config::ConfigError("command line", 0, "--at", *options.at,
                              "is for the far camera; the near one measures where the body stands");
  }
  const vision::StonesSetup setup = stones_setup(rig);
  return {setup.camera, setup.shape, near_looker(setup)};
}

/// A picture that can not be read is one in which nothing can be said.
Look look_at(const Looker& looker, const Picture& picture, bool far) {
  if (!picture.bgr.empty()) return looker(picture);
  Look look;
  if (far) look.far.emplace();
  (far ? look.far->reason : look.stones.reason) = picture.problem;
  return look;
}

std::string line_of(const std::string& name, const Look& look, const TeamNames& teams, double elapsed_ms) {
  return look.far ? far_stones_line(name, *look.far, teams, elapsed_ms)
                  : stones_line(name, look.stones, teams, elapsed_ms);
}

/// All pictures of one robot that stands still.
struct Standing {
  vision::StoneAverage average;
  StandingStill still;
  int pictures = 0;
  std::vector<LeftOut> left_out;
  std::string refused;  ///< why the pictures say nothing together

  void add(const std::string& name, const Look& look) {
    ++pictures;
    if (refused.empty() && look.sheet) refused = still.contradiction(name, *look.sheet);
    average.add(look.stones);
    if (!look.stones.ok) left_out.push_back({name, look.stones.reason});
  }
};

int tell(const Standing& standing, const TeamNames& teams, double elapsed_ms) {
  const bool refused = !standing.refused.empty();
  const int frames = refused ? 0 : standing.average.frames();
  const std::string reason = refused ? standing.refused : frames == 0 ? "no picture shows the sheet" : "";
  fmt::print("{}\n", stones_sequence_line(standing.pictures, frames,
                                          refused ? std::vector<StoneSighting>() : standing.average.stones(),
                                          standing.left_out, reason, teams, elapsed_ms));
  return frames > 0 ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace

int run_stones(const StonesOptions& options) {
  const config::Rig rig = config::load_rig(options.rig);
  const Eyes eyes = eyes_for(options, rig);
  std::optional<DrawingFolder> drawings;
  if (options.draw) drawings.emplace("--draw", *options.draw);
  const auto& k = eyes.camera.intrinsics;
  const PictureReader next = read_pictures(options.images, {k.width_px, k.height_px}, std::nullopt);

  Standing standing;
  bool all_estimated = true;
  const auto start = Clock::now();
  while (const auto picture = next()) {
    const auto begin = Clock::now();
    const Look look = look_at(eyes.look, *picture, options.camera == "far");
    if (!options.sequence) {
      fmt::print("{}\n", line_of(picture->name, look, team_names(rig), ms_since(begin)));
      std::fflush(stdout);
    }
    if (drawings && look.ok()) {
      const vision::SheetCamera camera(vision::Lens(k), look.eMc, eyes.camera.ice);
      const vision::Board board = vision::judge(look.seen(), look.sheet_width_m);
      drawings->save(picture->name, drawing::draw_stones(picture->bgr, board, camera, eyes.shape));
    }
    if (options.sequence) standing.add(picture->name, look);
    all_estimated = all_estimated && look.ok();
  }
  if (!options.sequence) return all_estimated ? ExitStatus::success : ExitStatus::not_achieved;
  return tell(standing, team_names(rig), ms_since(start));
}

}  // namespace hogline
