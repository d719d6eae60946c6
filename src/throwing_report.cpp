#include "src/throwing_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "hw/files/png_writer.hpp"
#include "src/drawing/contact_sheet.hpp"
#include "src/drawing/picture_overlay.hpp"
#include "src/drawing/plot.hpp"
#include "src/drawing/sheet_plan.hpp"
#include "src/output/output_file.hpp"

namespace hogline {
namespace {

using namespace drawing;

constexpr double deg = 180.0 / std::numbers::pi;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void write_picture(const std::string& path, const cv::Mat& picture) {
  if (const auto problem = hw::files::write_png(path, picture)) throw std::runtime_error(*problem);
}

Series series(const ThrowLog& log, std::string name, Ink ink, SeriesStyle style, double (*value)(const ThrowSample&)) {
  Series s{.name = std::move(name), .x = {}, .y = {}, .ink = ink, .style = style};
  for (const ThrowSample& sample : log.samples) {
    s.x.push_back(sample.t_s);
    s.y.push_back(value(sample));
  }
  return s;
}

std::vector<PlotMark> state_marks(const ThrowResult& result) {
  std::vector<PlotMark> marks;
  for (const StateTime& s : result.states) marks.push_back({s.t_s, s.name});
  return marks;
}

// The time that matters: until the robot stands again, not while the stone slides.
double standing_again_s(const ThrowOutcome& outcome) {
  const auto& states = outcome.result.states;
  return states.empty() ? 1.0 : states.back().t_s + 0.5;
}

bool driving(const ThrowSample& s) { return s.state >= servo::ThrowerState::run; }

cv::Mat plots_of(const ThrowOutcome& outcome, cv::Size size) {
  const ThrowLog& log = outcome.log;
  std::vector<Plot> plots(3);
  plots[0].title = "speed";
  plots[0].y_label = "m/s";
  plots[0].series = {
      series(log, "truth", inks::text, SeriesStyle::line, [](const ThrowSample& s) { return s.true_speed_mps; }),
      series(log, "believed", inks::blue, SeriesStyle::line, [](const ThrowSample& s) { return s.believed_speed_mps; }),
      series(log, "set point", inks::red, SeriesStyle::dashed,
             [](const ThrowSample& s) { return driving(s) ? s.speed_setpoint_mps : nothing; })};
  plots[1].title = "heading";
  plots[1].y_label = "deg";
  plots[1].series = {series(log, "truth", inks::text, SeriesStyle::line,
                            [](const ThrowSample& s) { return s.true_body.yaw_rad * deg; }),
                     series(log, "believed", inks::blue, SeriesStyle::line, [](const ThrowSample& s) {
                       return s.state >= servo::ThrowerState::align ? s.believed_yaw_rad * deg : nothing;
                     })};
  plots[2].title = "distance to the hog line";
  plots[2].y_label = "m";
  plots[2].series = {
      series(log, "truth", inks::text, SeriesStyle::line, [](const ThrowSample& s) { return s.true_hog_distance_m; }),
      series(log, "believed", inks::blue, SeriesStyle::line, [](const ThrowSample& s) {
        return s.state >= servo::ThrowerState::fold ? s.believed_hog_distance_m : nothing;
      })};
  for (Plot& p : plots) {
    p.marks = state_marks(outcome.result);
    p.x_low = 0.0;
    p.x_high = standing_again_s(outcome);
  }
  plots.back().x_label = "time / s";
  return draw_plots(plots, size);
}

cv::Mat plan_of(const ThrowRequest& request, const ThrowOutcome& outcome, int length_px) {
  SheetPlan plan;
  plan.title = "the throw";
  plan.width_m = request.scenario.sheet.width_m;
  PlanTrack robot{.name = "robot", .points_m = {}, .ink = inks::blue};
  PlanTrack stone{.name = "stone", .points_m = {}, .ink = inks::red};
  for (std::size_t i = 0; i < outcome.log.samples.size(); i += 4) {
    const ThrowSample& s = outcome.log.samples[i];
    robot.points_m.emplace_back(s.true_body.x_m, s.true_body.y_m);
    if (!s.stone_held) stone.points_m.emplace_back(s.stone_x_m, s.stone_y_m);
  }
  if (!robot.points_m.empty()) {
    const Eigen::Vector2d from = robot.points_m.front();
    const Eigen::Vector2d along(-std::sin(request.order.heading_rad), std::cos(request.order.heading_rad));
    plan.tracks.push_back(
        {.name = "line of the shot", .points_m = {from, from + 38.0 * along}, .ink = inks::purple, .dashed = true});
  }
  plan.tracks.push_back(robot);
  plan.tracks.push_back(stone);
  if (outcome.result.release && !stone.points_m.empty()) {
    plan.marks.push_back({.name = "released", .place_m = stone.points_m.front()});
  }
  const ThrowSample& last = outcome.log.samples.back();
  PlanStone at_rest;
  at_rest.place_m = {last.stone_x_m, last.stone_y_m};
  at_rest.ringed = true;
  plan.stones.push_back(at_rest);
  return draw_sheet_plan(plan, length_px);
}

}  // namespace

void write_report(const std::string& folder, const ThrowRequest& request, const ThrowOutcome& outcome) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(fmt::format("{}: can not be made: {}", folder, error.message()));

  for (const char* name : {"/near.png", "/low.png"})
    std::filesystem::remove(folder + name, error);  // an earlier throw's
  cv::Mat near;
  cv::Mat low;
  if (const auto& s = outcome.near_sight) near = draw_near_view(s->frame.bgr, s->percept, s->sketch);
  if (const auto& s = outcome.low_sight) low = draw_low_view(s->frame.bgr, s->percept, s->sketch);
  if (!near.empty()) write_picture(folder + "/near.png", near);
  if (!low.empty()) write_picture(folder + "/low.png", low);

  const cv::Mat plan = plan_of(request, outcome, 1600);
  const cv::Mat plots = plots_of(outcome, {1200, 300});
  write_picture(folder + "/sheet.png", plan);
  write_picture(folder + "/plots.png", plots);
  write_picture(folder + "/overview.png", draw_contact_sheet({{{near, "near view: the sheet's pose before the run"},
                                                               {low, "low view: the last look at the hog line"}},
                                                              {{plan, "from above"}},
                                                              {{plots, "truth and belief"}}},
                                                             1600));

  outcome.log.write_csv(folder + "/log.csv");
  write_text(folder + "/result.json", result_line(outcome.result) + "\n");
}

}  // namespace hogline
