#include "src/turn_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "hw/digital_curling/messages.hpp"
#include "hw/files/png_writer.hpp"
#include "src/drawing/board_picture.hpp"
#include "src/drawing/contact_sheet.hpp"
#include "src/drawing/picture_overlay.hpp"
#include "src/drawing/sheet_plan.hpp"
#include "src/output/output_file.hpp"
#include "src/stones_setup.hpp"
#include "src/team/throw_table.hpp"

namespace hogline {
namespace {

using namespace drawing;
using nlohmann::ordered_json;

constexpr double deg = 180.0 / std::numbers::pi;
constexpr double hack_in_e_m = vision::rules::tee_to_hack_m;  // s less the thrower's e, along y

void write_picture(const std::filesystem::path& path, const cv::Mat& picture) {
  std::filesystem::remove(path);  // an earlier turn's
  if (picture.empty()) return;
  if (const auto problem = hw::files::write_png(path.string(), picture)) throw std::runtime_error(*problem);
}

// ---- from above: e of the thrower ----

Eigen::Vector2d in_thrower(const servo::BoardStone& s) { return {s.x_m, s.y_m - hack_in_e_m}; }
Eigen::Vector2d from_skip(double x_m, double y_m) { return {-x_m, vision::rules::tee_to_tee_m - y_m}; }

Eigen::Matrix2d matrix(const PlaceCovariance& c) {
  return (Eigen::Matrix2d() << c.xx_m2, c.xy_m2, c.xy_m2, c.yy_m2).finished();
}

std::vector<Eigen::Vector2d> points(const std::vector<servo::Place>& path) {
  std::vector<Eigen::Vector2d> all;
  for (const servo::Place& p : path) all.emplace_back(p.x_m, p.y_m);
  return all;
}

void add_stones(SheetPlan& plan, const TurnRecord& r) {
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto& stone = r.report.seen.lying.stones[side][i];
      if (!stone) continue;
      plan.stones.push_back({.place_m = in_thrower(*stone),
                             .handle_rad = stone->angle_rad,
                             .team = side == 0 ? inks::red : inks::yellow,
                             .label = std::to_string(i + 1),
                             .ringed = side == servo::side_of(r.turn.team) && i == r.turn.stone});
    }
  }
}

/// Where the stones lay that were struck, without colour.
void add_stones_before(SheetPlan& plan, const TurnRecord& r) {
  constexpr double moved_m = 0.05;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto &before = r.turn.board.stones[side][i], &after = r.report.seen.lying.stones[side][i];
      if (!before || (after && std::hypot(after->x_m - before->x_m, after->y_m - before->y_m) < moved_m)) continue;
      plan.stones.push_back(
          {.place_m = in_thrower(*before), .handle_rad = before->angle_rad, .team = inks::grid, .label = {}});
    }
  }
}

void add_skips_view(SheetPlan& plan, const TurnRecord& r) {
  if (!r.followed) return;
  PlanTrack trail{.name = "as the skip saw it", .points_m = {}, .ink = inks::blue};
  for (const servo::TrajectoryPoint& p : r.followed->result.trajectory) {
    trail.points_m.push_back(from_skip(p.x_m, p.y_m));
  }
  plan.tracks.push_back(trail);
  for (const servo::WorldCollision& c : r.followed->result.collisions) {
    plan.marks.push_back({.name = "hit", .place_m = from_skip(c.x_m, c.y_m)});
  }
  if (!r.foretold || r.report.seen.struck) return;  // a stone that strikes another does not stop there
  plan.ellipses.push_back({.place_m = from_skip(r.foretold->x_m, r.foretold->y_m),
                           .covariance_m2 = matrix(r.foretold->covariance),
                           .ink = inks::green});
}

cv::Mat plan_of(const ToldTurn& told, double from_y_m, double to_y_m, const std::string& title, int length_px) {
  const TurnRecord& r = *told.record;
  SheetPlan plan;
  plan.title = title;
  plan.width_m = told.team->request().scenario.sheet.width_m;
  plan.from_y_m = from_y_m;
  plan.to_y_m = to_y_m;
  plan.tracks.push_back({.name = "thrower", .points_m = points(r.robot_path), .ink = inks::purple});
  plan.tracks.push_back({.name = "stone", .points_m = points(r.stone_path), .ink = inks::red});
  add_skips_view(plan, r);
  add_stones_before(plan, r);
  add_stones(plan, r);
  if (!r.stone_path.empty() && from_y_m < 0.0) {
    plan.marks.push_back({.name = "released", .place_m = points(r.stone_path).front()});
  }
  return draw_sheet_plan(plan, length_px);
}

// ---- what the cameras showed ----

cv::Mat with_stones(const hw::Frame& frame, const std::vector<StoneSighting>& stones, const std::array<double, 16>& eMc,
                    const vision::CameraSetup& camera, const config::Rig& rig) {
  const vision::SheetCamera seen_by(vision::Lens(camera.intrinsics), vision::from_row_major(eMc), camera.ice);
  return draw_stones(frame.bgr, vision::judge(stones, std::nullopt), seen_by, stones_setup(rig).shape);
}

struct Views {
  cv::Mat near, low, house_before, house_after, far;
};

cv::Mat house(const std::optional<SkipSights::Near>& sight, const config::Rig& rig) {
  if (!sight) return {};
  return with_stones(sight->frame, sight->seen.stones.stones, sight->seen.sheet.eMc, rig.camera("near"), rig);
}

Views views_of(const ToldTurn& told) {
  Views views;
  const config::Rig& rig = told.team->request().skip.rig;
  if (const VisionSeer* eyes = told.team->thrower_eyes()) {
    if (const auto& s = eyes->near_sight()) views.near = draw_near_view(s->frame.bgr, s->percept, s->sketch);
    if (const auto& s = eyes->low_sight()) views.low = draw_low_view(s->frame.bgr, s->percept, s->sketch);
  }
  views.house_before = house(told.house_before, rig);
  views.house_after = house(told.team->skip_sights().house, rig);
  if (const auto& far = told.team->skip_sights().far) {
    views.far = with_stones(far->frame, far->seen.stones, far->seen.eMc, rig.camera("far"), rig);
  }
  return views;
}

// ---- what the pictures' captions say ----

std::string caption_of_throw(const TurnRecord& r) {
  std::string words = fmt::format("4  {}: ordered {:.2f} m/s", r.turn.decision.plan, r.report.order.speed_mps);
  if (const auto& t = r.thrower.release)
    words += fmt::format(", let go {:.2f} m before the line, {:.1f} mm/s off", t->hog_distance_m,
                         1e3 * std::abs(t->speed_error_mps));
  if (r.followed && r.followed->result.hog_to_hog_s)
    words += fmt::format("; {:.2f} s hog to hog", r.followed->result.hog_to_hog_s->value);
  return words;
}

std::string title_of_house(const TurnRecord& r) {
  std::string words = "where it ends: hits, stones by their number (grey: before)";
  if (r.foretold && !r.report.seen.struck) words += ", the stop foretold at the hog line (green)";
  return words;
}

std::string caption_of_house(const TurnRecord& r) {
  int gone = 0;
  for (const std::size_t side : {0u, 1u})
    for (std::size_t i = 0; i < servo::stones_each; ++i)
      gone += r.turn.board.stones[side][i] && !r.report.seen.lying.stones[side][i] ? 1 : 0;
  const std::size_t hits = r.followed ? r.followed->result.collisions.size() : 0;
  return fmt::format("7  where it ends: {} hit{}, {} stone{} out; seen within {:.0f} mm of the truth", hits,
                     hits == 1 ? "" : "s", gone, gone == 1 ? "" : "s", 1e3 * worst_place_m(r));
}

// ---- JSON ----

ordered_json place(double x_m, double y_m) { return {{"x_m", x_m}, {"y_m", y_m}}; }

ordered_json board_json(const servo::Board& board) {
  ordered_json stones = ordered_json::array();
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto& stone = board.stones[side][i];
      if (stone)
        stones.push_back({{"team", hw::digital_curling::team_name(servo::team_of(side))},
                          {"stone", i},
                          {"x_m", stone->x_m},
                          {"y_m", stone->y_m}});
    }
  }
  return stones;
}

ordered_json release_json(const TurnRecord& r) {
  if (!r.release) return nullptr;
  ordered_json told{{"speed_mps", r.release->speed_mps},
                    {"heading_deg", r.release->heading_rad * deg},
                    {"spin_radps", r.release->spin_radps},
                    {"hog_distance_m", r.release->hog_distance_m},
                    {"lateral_m", r.release->lateral_m}};
  if (const auto& t = r.thrower.release) {
    told["against_truth"] = {{"place_mm", 1e3 * (t->hog_distance_m - t->target_hog_distance_m)},
                             {"speed_error_mps", t->speed_error_mps},
                             {"heading_error_deg", t->heading_error_rad * deg},
                             {"lateral_error_mm", 1e3 * t->lateral_error_m}};
  }
  return told;
}

ordered_json lesson_json(const TurnRecord& r) {
  if (!r.lesson) return nullptr;
  const servo::StopPrediction& f = r.lesson->foretold;
  return {{"foretold", place(f.x_m, f.y_m)},
          {"sigma_m", std::sqrt(f.covariance.xx_m2 + f.covariance.yy_m2)},
          {"rest", place(r.lesson->rest.x_m, r.lesson->rest.y_m)},
          {"error_m", r.lesson->error_m()}};
}

}  // namespace

std::string turn_json(const TurnRecord& r) {
  const auto& c = r.ice.covariance;
  const bool thrown = r.report.end == game::ThrowEnd::thrown;
  ordered_json told{{"version", 1},
                    {"ok", thrown && (!r.followed || r.followed->ok)},
                    {"reason", thrown ? (r.followed ? r.followed->reason : "") : r.report.reason},
                    {"remarks", r.remarks},
                    {"attempts", r.attempts},
                    {"plan", r.turn.decision.plan},
                    {"order",
                     {{"speed_mps", r.report.order.speed_mps},
                      {"heading_deg", r.report.order.heading_rad * deg},
                      {"curl", r.report.order.curl == servo::Curl::clockwise ? "cw" : "ccw"},
                      {"spin_radps", r.report.order.spin_radps}}},
                    {"release", release_json(r)},
                    {"struck", r.report.seen.struck},
                    {"board", board_json(r.report.seen.lying)},
                    {"ice",
                     {{"friction_scale", r.ice.friction_scale},
                      {"friction_sigma", std::sqrt(c[0])},
                      {"curl_gain", r.ice.curl_gain},
                      {"curl_sigma", std::sqrt(c[4])},
                      {"throws", r.ice.throws}}},
                    {"foretold", lesson_json(r)},
                    {"true_board", board_json(r.truth.stones.lying)},
                    {"simulated_s", r.simulated_s},
                    {"wall_s", r.wall_s}};
  return told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_turn(const std::string& folder, const ToldTurn& told) {
  const std::filesystem::path out(folder);
  const Views views = views_of(told);
  const cv::Mat above = plan_of(told, -5.5, 40.5, "from above: throw and run", 1600);
  const cv::Mat close = plan_of(told, 27.0, 38.0, title_of_house(*told.record), 1600);
  write_picture(out / "near.png", views.near);
  write_picture(out / "low.png", views.low);
  write_picture(out / "house_before.png", views.house_before);
  write_picture(out / "house_after.png", views.house_after);
  write_picture(out / "far.png", views.far);
  write_picture(out / "above.png", above);
  write_picture(out / "house.png", close);
  write_picture(
      out / "overview.png",
      draw_contact_sheet({{{views.house_before, "1  the skip finds the stones"},
                           {views.near, "2  the thrower finds its place"},
                           {views.low, "3  ... and the hog line, running"}},
                          {{above, caption_of_throw(*told.record)}},
                          {{views.far, "5  the skip follows the stone"}, {views.house_after, "6  the skip counts"}},
                          {{close, caption_of_house(*told.record)}}},
                         1100));
  replace_text(out / "turn.json", turn_json(*told.record) + "\n");
}

}  // namespace hogline
