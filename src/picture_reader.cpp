#include "src/picture_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "hw/files/image_file.hpp"
#include "hw/files/recorded_camera.hpp"
#include "src/config/config_error.hpp"

namespace hogline {
namespace {

namespace fs = std::filesystem;
using hw::files::Recording;

constexpr double usual_rate_hz = 60.0;

// One picture that can not be read, or that another camera took, is one in which nothing is estimated: a run of a
// thousand is not lost for it.
Picture read_file(const hw::files::RecordedFrame& frame, cv::Size size) {
  hw::files::LoadedImage loaded = hw::files::load_image(frame.path, size);
  Picture picture{.name = frame.path, .bgr = loaded.bgr, .stamp = Stamp{frame.time}, .problem = {}};
  if (loaded.error) picture.problem = loaded.error->what;
  return picture;
}

PictureReader play_files(Recording recording, cv::Size size) {
  return [recording = std::move(recording), size, next = std::size_t{0}]() mutable -> std::optional<Picture> {
    if (next >= recording.frames.size()) return std::nullopt;
    return read_file(recording.frames[next++], size);
  };
}

PictureReader play_video(const std::string& path, cv::Size size, double rate_hz) {
  auto video = std::make_shared<hw::files::VideoCamera>("", path, rate_hz, size, Stamp{});
  if (video->error()) throw config::ConfigError(path, 0, "", "", video->error()->what);
  return [video, path, count = 0]() mutable -> std::optional<Picture> {
    const auto stamp = video->next_stamp();
    if (!stamp) return std::nullopt;
    Picture picture{.name = fmt::format("{}#{}", path, count++), .bgr = {}, .stamp = *stamp, .problem = {}};
    if (auto frame = video->latest(*stamp)) {
      picture.bgr = frame->bgr;
    } else {
      picture.problem = video->error() ? video->error()->what : "can not be decoded";
      video->rearm();
    }
    return picture;
  };
}

Recording listed(const std::vector<std::string>& names, double rate_hz) {
  Recording recording;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::error_code error;
    if (fs::is_directory(names[k], error))
      throw config::ConfigError(names[k], 0, "", "", "is a folder; give it alone, or the pictures in it");
    if (fs::exists(names[k], error) && !fs::is_regular_file(names[k], error))
      throw config::ConfigError(names[k], 0, "", "", "is not a file; give the path of a readable JPEG or PNG file");
    if (!fs::is_regular_file(names[k], error))
      throw config::ConfigError(names[k], 0, "", "", "no such picture; give the path of a readable JPEG or PNG file");
    recording.frames.push_back({names[k], k, from_seconds(static_cast<double>(k) / rate_hz)});
  }
  return recording;
}

bool is_one_of(const std::string& path, std::initializer_list<const char*> extensions) {
  const std::string extension = fs::path(path).extension().string();
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

}  // namespace

PictureReader read_pictures(const std::vector<std::string>& names, cv::Size size, std::optional<double> rate_hz) {
  const double steady_hz = rate_hz.value_or(usual_rate_hz);
  if (names.size() != 1) return play_files(listed(names, steady_hz), size);
  const std::string& name = names.front();
  if (fs::is_regular_file(name) && is_one_of(name, {".avi", ".mkv", ".mov", ".mp4", ".webm"})) {
    return play_video(name, size, rate_hz.value_or(0.0));
  }
  Recording recording = fs::is_directory(name)      ? hw::files::read_folder(name, steady_hz)
                        : is_one_of(name, {".csv"}) ? hw::files::read_stamps_file(name)
                                                    : listed(names, steady_hz);
  if (!recording.problem.empty()) throw config::ConfigError("command line", 0, "IMAGE", name, recording.problem);
  return play_files(std::move(recording), size);
}

}  // namespace hogline
