#include "src/drawing_file.hpp"

#include <filesystem>
#include <stdexcept>

#include "hw/files/png_writer.hpp"

namespace hogline {

void save_drawing(const std::string& folder, const std::string& picture, const cv::Mat& drawing) {
  std::filesystem::path name = std::filesystem::path(picture).filename();
  if (name.string().find('#') == std::string::npos) name = name.stem();
  if (const auto problem = hw::files::write_png((std::filesystem::path(folder) / name).string() + ".png", drawing)) {
    throw std::runtime_error(*problem);
  }
}

}  // namespace hogline
