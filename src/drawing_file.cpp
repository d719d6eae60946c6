#include "src/drawing_file.hpp"

#include <filesystem>
#include <stdexcept>

#include "hw/files/png_writer.hpp"
#include "src/output/output_file.hpp"

namespace hogline {

namespace fs = std::filesystem;

DrawingFolder::DrawingFolder(const std::string& option, const std::string& folder) : folder_(folder) {
  check_folder(option, folder);
}

std::string DrawingFolder::name_for(const std::string& picture) {
  const fs::path path(picture);
  const std::string file = path.filename().string();
  const std::string name = file.find('#') == std::string::npos ? path.stem().string() : file;
  const std::string longer = fs::absolute(path).parent_path().filename().string() + "-" + name;
  const auto is_free = [&](const std::string& n) {
    const auto entry = taken_.find(n);
    return entry == taken_.end() || entry->second == picture;
  };
  if (is_free(name)) return name;
  if (is_free(longer)) return longer;
  int number = 2;
  while (!is_free(longer + "-" + std::to_string(number))) ++number;
  return longer + "-" + std::to_string(number);
}

std::string DrawingFolder::save(const std::string& picture, const cv::Mat& drawing) {
  const std::string name = name_for(picture);
  taken_[name] = picture;
  const std::string path = (fs::path(folder_) / name).string() + ".png";
  if (const auto problem = hw::files::write_png(path, drawing)) throw std::runtime_error(*problem);
  return path;
}

}  // namespace hogline
