#include "src/pictures.hpp"

#include <filesystem>
#include <stdexcept>

#include "hw/files/png_writer.hpp"
#include "src/config/config_error.hpp"

namespace hogline {

void check_pictures_exist(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (!std::filesystem::is_regular_file(path)) {
      throw config::ConfigError(path, 0, "", "", "no such picture; give the path of a readable JPEG or PNG file");
    }
  }
}

hw::files::LoadedImage read_picture(const std::string& path, const vision::Intrinsics& camera) {
  using hw::files::ImageErrorKind;
  hw::files::LoadedImage loaded = hw::files::load_image(path, {camera.width_px, camera.height_px});
  if (loaded.error && loaded.error->kind != ImageErrorKind::wrong_size &&
      loaded.error->kind != ImageErrorKind::wrong_format) {
    throw config::ConfigError(path, 0, "", "", loaded.error->what);
  }
  return loaded;
}

void save_drawing(const std::string& folder, const std::string& picture, const cv::Mat& drawing) {
  const std::filesystem::path name = std::filesystem::path(picture).stem();
  if (const auto problem = hw::files::write_png((std::filesystem::path(folder) / name).string() + ".png", drawing)) {
    throw std::runtime_error(*problem);
  }
}

}  // namespace hogline
