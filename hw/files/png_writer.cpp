#include "hw/files/png_writer.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace hogline::hw::files {

std::optional<std::string> write_png(const std::string& path, const cv::Mat& picture) {
  if (picture.empty() || picture.depth() != CV_8U) return path + ": only 8-bit pictures can be written";

  std::vector<std::uint8_t> bytes;
  constexpr int quick = 3;  // of 9: camera noise hardly compresses any further
  if (!cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, quick}))
    return path + ": cannot be encoded as PNG";

  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code code;
  if (!folder.empty()) std::filesystem::create_directories(folder, code);
  if (code) return path + ": its folder cannot be made: " + code.message();

  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return path + ": cannot be written: " + std::strerror(errno);
  return std::nullopt;
}

}  // namespace hogline::hw::files
