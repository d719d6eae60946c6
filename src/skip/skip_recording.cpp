#include "src/skip/skip_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string_view>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

namespace fs = std::filesystem;

constexpr double deg = std::numbers::pi / 180.0;
constexpr Duration beyond = std::chrono::milliseconds(50);
constexpr int jpeg_quality = 95;

hw::files::Recording stamps(const std::string& path) {
  if (!fs::exists(path)) return {};
  hw::files::Recording recording = hw::files::read_stamps_file(path);
  if (!recording.problem.empty()) throw config::ConfigError(path, 0, "", "", recording.problem);
  return recording;
}

HeadRow head_row(const std::string& line, const std::string& path, int number) {
  double time_s = 0.0, pan_deg = 0.0, tilt_deg = 0.0;
  char rest = 0;
  const int read = std::sscanf(line.c_str(), "%lf,%lf,%lf%c", &time_s, &pan_deg, &tilt_deg, &rest);
  if (read != 3 || !std::isfinite(time_s + pan_deg + tilt_deg) || std::abs(time_s) > 1e6) {
    throw config::ConfigError(path, number, "time_s,pan_deg,tilt_deg", line, "must be three numbers");
  }
  return {from_seconds(time_s), {pan_deg * deg, tilt_deg * deg}};
}

std::vector<HeadRow> head_rows(const std::string& path) {
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line) || line != "time_s,pan_deg,tilt_deg") {
    throw config::ConfigError(path, 1, "", line, "must begin with the line time_s,pan_deg,tilt_deg");
  }
  std::vector<HeadRow> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    rows.push_back(head_row(line, path, number));
    if (rows.size() > 1 && rows.back().time < rows[rows.size() - 2].time) {
      throw config::ConfigError(path, number, "time_s", line, "must not fall from line to line");
    }
  }
  if (rows.empty()) throw config::ConfigError(path, 0, "", "", "holds no angles");
  return rows;
}

constexpr const char* release_names =
    "heard_s,time_s,x_m,y_m,vx_mps,vy_mps,spin_radps,place_sigma_m,velocity_sigma_mps,team";
constexpr std::array<const char*, 3> team_words{"first", "second", "unknown"};

std::optional<RecordedRelease> release_of(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) return std::nullopt;
  std::string line;
  if (!std::getline(stream, line) || line != release_names) {
    throw config::ConfigError(path, 1, "", line, std::string("must begin with the line ") + release_names);
  }
  line.clear();
  std::getline(stream, line);
  double heard_s = 0.0, time_s = 0.0;
  RecordedRelease release;
  servo::ReleaseSignal& r = release.signal;
  servo::SlidingStone& s = r.stone;
  std::array<char, 8> word{};
  char rest = 0;
  const int read =
      std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%7[a-z]%c", &heard_s, &time_s, &s.x_m, &s.y_m,
                  &s.vx_mps, &s.vy_mps, &s.spin_radps, &r.place_sigma_m, &r.velocity_sigma_mps, word.data(), &rest);
  const auto team = std::find(team_words.begin(), team_words.end(), std::string_view(word.data()));
  const double sum = heard_s + time_s + s.x_m + s.y_m + s.vx_mps + s.vy_mps + s.spin_radps;
  const bool good = read == 10 && team != team_words.end() && std::isfinite(sum) && std::abs(heard_s) < 1e6 &&
                    std::abs(time_s) < 1e6 && r.place_sigma_m > 0.0 && r.velocity_sigma_mps > 0.0 &&
                    std::isfinite(r.place_sigma_m + r.velocity_sigma_mps);
  if (!good) {
    throw config::ConfigError(path, 2, release_names, line,
                              "must be nine numbers, the sigmas above 0, and first, second or unknown");
  }
  release.heard = from_seconds(heard_s);
  r.stamp = Stamp{from_seconds(time_s)};
  r.team = static_cast<Team>(team - team_words.begin());
  return release;
}

}  // namespace

SkipRecording read_skip_recording(const std::string& folder) {
  SkipRecording recording{
      .near = stamps(folder + "/near.csv"), .far = stamps(folder + "/far.csv"), .head = {}, .release = {}};
  if (recording.near.frames.empty() && recording.far.frames.empty()) {
    throw config::ConfigError(folder, 0, "near.csv, far.csv", "", "missing; a recorded throw has one of them at least");
  }
  recording.head = head_rows(folder + "/head.csv");
  recording.release = release_of(folder + "/release.csv");
  return recording;
}

std::optional<servo::HeadAngles> angles_at(const SkipRecording& recording, Duration time) {
  const auto& rows = recording.head;
  if (time < rows.front().time - beyond || time > rows.back().time + beyond) return std::nullopt;
  const auto next = std::find_if(rows.begin(), rows.end(), [&](const HeadRow& r) { return r.time >= time; });
  if (next == rows.end()) return rows.back().angles;
  if (next == rows.begin() || next->time == time) return next->angles;
  const HeadRow &a = *std::prev(next), &b = *next;
  const double u = seconds(time - a.time) / seconds(b.time - a.time);
  return servo::HeadAngles{a.angles.pan_rad + u * (b.angles.pan_rad - a.angles.pan_rad),
                           a.angles.tilt_rad + u * (b.angles.tilt_rad - a.angles.tilt_rad)};
}

struct RecordingSeer::Files {
  explicit Files(const std::string& where) : folder(where), near(where + "/near.csv"), far(where + "/far.csv") {
    near << "name,id,time_s\n";
    far << "name,id,time_s\n";
  }

  void write(std::ofstream& list, const char* camera, const hw::Frame& frame, const servo::HeadAngles& q) {
    const std::string name = fmt::format("{}-{:06}.jpg", camera, frame.id);
    const double time_s = seconds(frame.stamp.time_since_epoch());
    list << fmt::format("{},{},{:.6f}\n", name, frame.id, time_s);
    rows.push_back({frame.stamp.time_since_epoch(), q});
    if (!cv::imwrite(folder + "/" + name, frame.bgr, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality}) || !list) {
      throw std::runtime_error(folder + "/" + name + ": can not be written; check the folder and the disk's space");
    }
  }

  std::string folder;
  std::ofstream near;
  std::ofstream far;
  std::vector<HeadRow> rows;  ///< of both cameras' pictures: the later one may have been exposed earlier
};

RecordingSeer::RecordingSeer(SkipSeer& seer, const std::string& folder)
    : files_(std::make_unique<Files>(folder)), seer_(seer) {}

RecordingSeer::~RecordingSeer() {
  std::ranges::sort(files_->rows, {}, &HeadRow::time);
  std::ofstream head(files_->folder + "/head.csv");
  head << "time_s,pan_deg,tilt_deg\n";
  for (const HeadRow& r : files_->rows) {
    head << fmt::format("{:.6f},{:.5f},{:.5f}\n", seconds(r.time), r.angles.pan_rad / deg, r.angles.tilt_rad / deg);
  }
}

void RecordingSeer::hear(const servo::ReleaseSignal& r, Stamp now) {
  const auto count = [](Stamp stamp) { return seconds(stamp.time_since_epoch()); };
  const servo::SlidingStone& s = r.stone;
  std::ofstream file(files_->folder + "/release.csv");
  file << release_names << "\n"
       << fmt::format("{:.6f},{:.6f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{}\n", count(now), count(r.stamp),
                      s.x_m, s.y_m, s.vx_mps, s.vy_mps, s.spin_radps, r.place_sigma_m, r.velocity_sigma_mps,
                      team_words[static_cast<std::size_t>(r.team)]);
}

servo::NearSight RecordingSeer::near_view(const hw::Frame& frame, const servo::HeadAngles& q,
                                          const servo::SkipDiagnosis& known) {
  files_->write(files_->near, "near", frame, q);
  return seer_.near_view(frame, q, known);
}

FarPercept RecordingSeer::far_view(const hw::Frame& frame, const servo::HeadAngles& q,
                                   const servo::SkipDiagnosis& known) {
  files_->write(files_->far, "far", frame, q);
  return seer_.far_view(frame, q, known);
}

}  // namespace hogline
