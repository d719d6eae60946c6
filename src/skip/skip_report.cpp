#include "src/skip/skip_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "hw/files/png_writer.hpp"
#include "src/drawing/sheet_plan.hpp"
#include "src/output/output_file.hpp"

namespace hogline {
namespace {

using nlohmann::ordered_json;

constexpr double deg = 180.0 / std::numbers::pi;

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

ordered_json measured(const std::optional<servo::Measured>& m) {
  if (!m) return nullptr;
  return {{"value", m->value}, {"sigma", m->sigma}};
}

ordered_json covariance(const PlaceCovariance& c) { return {c.xx_m2, c.xy_m2, c.yy_m2}; }

const char* name_of(servo::StoneFate fate) {
  switch (fate) {
    case servo::StoneFate::at_rest:
      return "at_rest";
    case servo::StoneFate::hogged:
      return "hogged";
    case servo::StoneFate::sideline:
      return "out_sideline";
    case servo::StoneFate::through:
      return "out_through";
    case servo::StoneFate::lost:
      return "lost";
  }
  return "unknown";
}

std::string name_of(Team team, const TeamNames& names) {
  if (team == Team::unknown) return "unknown";
  return team == Team::first ? names.first : names.second;
}

ordered_json collisions(const ToldThrow& told) {
  ordered_json all = ordered_json::array();
  for (const servo::WorldCollision& c : told.report->result.collisions) {
    all.push_back({{"time_s", seconds(c.stamp - told.origin)},
                   {"striker", c.striker},
                   {"struck", c.struck},
                   {"x_m", c.x_m},
                   {"y_m", c.y_m}});
  }
  return all;
}

ordered_json stones(const ToldThrow& told) {
  ordered_json all = ordered_json::array();
  for (const servo::StoneOutcome& s : told.report->result.stones) {
    all.push_back({{"id", s.id},
                   {"team", name_of(s.team, told.teams)},
                   {"thrown", s.thrown},
                   {"moved", s.moved},
                   {"fate", name_of(s.fate)},
                   {"certain", s.certain},
                   {"x_m", s.x_m},
                   {"y_m", s.y_m},
                   {"covariance_m2", covariance(s.covariance)}});
  }
  return all;
}

ordered_json ice(const ToldThrow& told) {
  if (!told.ice) return nullptr;
  const auto& c = told.ice->covariance;
  return {{"friction_scale", told.ice->friction_scale},
          {"friction_sigma", std::sqrt(c[0])},
          {"curl_gain", told.ice->curl_gain},
          {"curl_sigma", std::sqrt(c[4])},
          {"lateral_mps2", told.ice->lateral_mps2},
          {"lateral_sigma_mps2", std::sqrt(c[8])},
          {"throws", told.ice->throws}};
}

ordered_json body(const ToldThrow& told) {
  if (!told.known->body) return nullptr;
  const PlanarPose& b = *told.known->body;
  return {{"x_m", b.x_m}, {"y_m", b.y_m}, {"yaw_deg", b.yaw_rad * deg}};
}

ordered_json foretold(const ToldThrow& told) {
  if (!told.foretold) return nullptr;
  return {{"x_m", told.foretold->x_m},
          {"y_m", told.foretold->y_m},
          {"covariance_m2", covariance(told.foretold->covariance)}};
}

ordered_json figures(const SkipOutcome& outcome) {
  const SkipFigures f = figures_of(outcome);
  const auto region = [](const RegionErrors& r) {
    return ordered_json{{"house_m", rounded(r.house_m.value(), 1e5)},
                        {"near_hog_m", rounded(r.near_hog_m.value(), 1e5)},
                        {"far_hog_m", rounded(r.far_hog_m.value(), 1e5)}};
  };
  ordered_json rest = ordered_json::array();
  for (const double e : f.rest_errors_m) rest.push_back(rounded(e, 1e5));
  return {{"aim_rms_deg", rounded(f.aim_deg.value(), 1e5)},
          {"aim_worst_deg", rounded(f.worst_aim_deg, 1e5)},
          {"joint_room_deg", rounded(f.room_deg, 1e3)},
          {"settle_s", f.settle_s},
          {"trajectory_rms", region(f.trajectory)},
          {"live_rms", region(f.live)},
          {"hog_to_hog_error_s", f.hog_to_hog_error_s ? ordered_json(*f.hog_to_hog_error_s) : ordered_json(nullptr)},
          {"rest_errors_m", rest},
          {"true_collisions", f.true_collisions},
          {"missed_collisions", f.missed_collisions},
          {"invented_collisions", f.invented_collisions},
          {"swaps", f.swaps},
          {"wrong_fates", f.wrong_fates},
          {"near_frames", outcome.near_frames},
          {"far_frames", outcome.far_frames},
          {"simulated_s", rounded(outcome.simulated_s, 1e3)}};
}

drawing::Ink ink_of(Team team) {
  if (team == Team::unknown) return drawing::inks::faint;
  return team == Team::first ? drawing::inks::red : drawing::inks::yellow;
}

Eigen::Matrix2d matrix(const PlaceCovariance& c) {
  return (Eigen::Matrix2d() << c.xx_m2, c.xy_m2, c.xy_m2, c.yy_m2).finished();
}

std::string title_of(const servo::ThrowResult& result) {
  std::string title = result.ok ? "followed by the skip" : "no throw was followed";
  if (result.hog_to_hog_s) title += fmt::format(", hog to hog {:.2f} s", result.hog_to_hog_s->value);
  if (result.hog_to_rest_s) title += fmt::format(", hog to rest {:.2f} s", result.hog_to_rest_s->value);
  if (!result.collisions.empty()) title += fmt::format(", {} collisions", result.collisions.size());
  return title;
}

}  // namespace

std::string throw_json(const ToldThrow& told, int indent) {
  const servo::ThrowResult& r = told.report->result;
  ordered_json object{
      {"version", 1},
      {"ok", told.report->ok},
      {"reason", told.report->ok ? ordered_json(nullptr) : ordered_json(told.report->reason)},
      {"remarks", told.report->remarks},
      {"seen_by", told.seen_by},
      {"body", body(told)},
      {"hog_to_hog_s", measured(r.hog_to_hog_s)},
      {"hog_to_rest_s", measured(r.hog_to_rest_s)},
      {"curl_m", measured(r.curl_m)},
      {"spin_radps", r.rotation.ok ? ordered_json{{"value", r.rotation.spin_radps}, {"sigma", r.rotation.sigma_radps}}
                                   : ordered_json(nullptr)},
      {"looks", r.trajectory.size()},
      {"collisions", collisions(told)},
      {"stones", stones(told)},
      {"foretold_stop", foretold(told)},
      {"ice", ice(told)}};
  if (told.unread) object["unread"] = *told.unread;
  if (told.truth) object["against_truth"] = figures(*told.truth);
  return object.dump(indent);
}

std::string trajectory_csv(const ToldThrow& told) {
  std::string text = "time_s,x_m,y_m,xx_m2,xy_m2,yy_m2\n";
  for (const servo::TrajectoryPoint& p : told.report->result.trajectory) {
    fmt::format_to(std::back_inserter(text), "{:.4f},{:.5f},{:.5f},{:.4e},{:.4e},{:.4e}\n",
                   seconds(p.stamp - told.origin), p.x_m, p.y_m, p.covariance.xx_m2, p.covariance.xy_m2,
                   p.covariance.yy_m2);
  }
  return text;
}

cv::Mat throw_picture(const ToldThrow& told, int length_px) {
  const servo::ThrowResult& result = told.report->result;
  drawing::SheetPlan plan;
  plan.title = title_of(result);
  plan.width_m = told.known->sheet_width_m.value_or(vision::rules::nominal_width_m);
  plan.from_y_m = -4.0;
  plan.to_y_m = 30.0;
  drawing::PlanTrack trail{.name = "trail up to the first collision", .points_m = {}, .ink = drawing::inks::blue};
  for (const servo::TrajectoryPoint& p : result.trajectory) trail.points_m.emplace_back(p.x_m, p.y_m);
  plan.tracks.push_back(trail);
  for (const servo::StoneOutcome& s : result.stones) {
    if (s.fate == servo::StoneFate::sideline || s.fate == servo::StoneFate::through) continue;
    plan.stones.push_back(
        {.place_m = {s.x_m, s.y_m}, .team = ink_of(s.team), .label = std::to_string(s.id), .ringed = s.thrown});
    if (s.moved) plan.ellipses.push_back({.place_m = {s.x_m, s.y_m}, .covariance_m2 = matrix(s.covariance)});
  }
  for (const servo::WorldCollision& c : result.collisions) {
    plan.marks.push_back({.name = fmt::format("{} on {}", c.striker, c.struck), .place_m = {c.x_m, c.y_m}});
  }
  if (told.foretold) {
    plan.ellipses.push_back({.place_m = {told.foretold->x_m, told.foretold->y_m},
                             .covariance_m2 = matrix(told.foretold->covariance),
                             .ink = drawing::inks::green});
  }
  return drawing::draw_sheet_plan(plan, length_px);
}

void write_throw(const std::string& folder, const ToldThrow& told) {
  write_text(folder + "/result.json", throw_json(told, 2) + "\n");
  write_text(folder + "/trajectory.csv", trajectory_csv(told));
  if (const auto problem = hw::files::write_png(folder + "/above.png", throw_picture(told, 1800))) {
    throw std::runtime_error(*problem);
  }
}

}  // namespace hogline
