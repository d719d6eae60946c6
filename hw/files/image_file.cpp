#include "hw/files/image_file.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "hw/files/image_container.hpp"
#include "hw/files/jpeg_damage.hpp"

namespace hogline::hw::files {
namespace {

std::string text(cv::Size size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

struct FileBytes {
  std::vector<std::uint8_t> bytes;
  std::optional<ImageError> error;
};

FileBytes read_all(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return {{}, ImageError{ImageErrorKind::missing, path, "no such file"}};
  if (std::filesystem::is_directory(status)) {
    return {{}, ImageError{ImageErrorKind::missing, path, "is a directory; name the pictures in it"}};
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return {{}, ImageError{ImageErrorKind::unreadable, path, std::string("cannot be opened: ") + std::strerror(errno)}};
  FileBytes read;
  std::array<char, 65536> chunk;
  while (file.read(chunk.data(), chunk.size()), file.gcount() > 0) {
    read.bytes.insert(read.bytes.end(), chunk.data(), chunk.data() + file.gcount());
  }
  if (file.bad()) read.error = ImageError{ImageErrorKind::unreadable, path, "cannot be read to its end"};
  return read;
}

std::optional<ImageError> bytes_error(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return ImageError{ImageErrorKind::truncated, path, "is empty; record or copy the picture again"};
  if (container_of(bytes) == Container::unknown) {
    return ImageError{ImageErrorKind::not_an_image, path,
                      "holds neither a JPEG nor a PNG picture; convert it to one of them"};
  }
  if (!is_complete(bytes)) {
    return ImageError{ImageErrorKind::truncated, path,
                      "ends early (" + std::to_string(bytes.size()) + " bytes); copy the picture again"};
  }
  if (container_of(bytes) == Container::jpeg) {
    if (const auto damage = jpeg_damage(bytes))
      return ImageError{ImageErrorKind::damaged, path, "is damaged (" + *damage + "); copy the picture again"};
  }
  return std::nullopt;
}

std::optional<ImageError> format_error(const std::string& path, const cv::Mat& picture, cv::Size size) {
  if (picture.size() != size) {
    return ImageError{
        ImageErrorKind::wrong_size, path,
        "is " + text(picture.size()) + " pixels, the rig's camera has " + text(size) +
            "; use the camera's own pictures, neither scaled nor cropped, or correct width_px and height_px"};
  }
  if (picture.depth() != CV_8U) {
    return ImageError{ImageErrorKind::wrong_format, path, "has more than 8 bits per channel; store 8-bit colour"};
  }
  if (picture.channels() != 3) {
    return ImageError{ImageErrorKind::wrong_format, path,
                      "has " + std::to_string(picture.channels()) + " channel" + (picture.channels() == 1 ? "" : "s") +
                          ", 3 are needed; store 8-bit colour without transparency"};
  }
  return std::nullopt;
}

}  // namespace

LoadedImage load_image(const std::string& path, cv::Size size) {
  FileBytes read = read_all(path);
  if (read.error) return {{}, read.error};
  if (auto error = bytes_error(path, read.bytes)) return {{}, error};

  cv::Mat picture;
  try {
    picture = cv::imdecode(read.bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty())
    return {{}, ImageError{ImageErrorKind::damaged, path, "cannot be decoded; copy the picture again"}};
  if (auto error = format_error(path, picture, size)) return {{}, error};
  return {picture, std::nullopt};
}

}  // namespace hogline::hw::files
