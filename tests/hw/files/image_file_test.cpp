// Loading pictures: what is whole comes back as it was written, everything else is refused by name.
#include "hw/files/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "hw/files/png_writer.hpp"

namespace hogline::hw::files {
namespace {

const cv::Size size{64, 48};

cv::Mat pattern(int type) {
  cv::Mat picture(size, type);
  cv::theRNG().state = 7;
  cv::randu(picture, cv::Scalar::all(0), cv::Scalar::all(255));
  return picture;
}

class ImageFile : public testing::Test {
 protected:
  ImageFile() : folder_(std::filesystem::temp_directory_path() / ("hogline-image-file-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ImageFile() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string encoded(const std::string& name, const cv::Mat& picture) const {
    EXPECT_TRUE(cv::imwrite(path(name), picture));
    return path(name);
  }

  std::string bytes(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  static std::string content(const std::string& file) {
    std::ostringstream all;
    all << std::ifstream(file, std::ios::binary).rdbuf();
    return all.str();
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(ImageFile, AWholePictureComesBackAsItWasWritten) {
  const cv::Mat picture = pattern(CV_8UC3);
  ASSERT_EQ(write_png(path("new/folder/a.png"), picture), std::nullopt);
  const LoadedImage loaded = load_image(path("new/folder/a.png"), size);
  ASSERT_FALSE(loaded.error) << loaded.error->message();
  EXPECT_EQ(cv::norm(loaded.bgr, picture, cv::NORM_INF), 0.0);

  const LoadedImage jpeg = load_image(encoded("b.jpg", picture), size);
  ASSERT_FALSE(jpeg.error) << jpeg.error->message();
  EXPECT_EQ(jpeg.bgr.type(), CV_8UC3);
}

TEST_F(ImageFile, EverythingElseIsRefusedWithItsKindAndItsName) {
  const std::string jpeg = content(encoded("whole.jpg", pattern(CV_8UC3)));
  const std::string png = content(encoded("whole.png", pattern(CV_8UC3)));
  std::string damaged = png;
  for (std::size_t i = 60; i < 400; ++i) damaged[i] = static_cast<char>(damaged[i] ^ 0x5A);

  std::string scratched = jpeg;
  for (std::size_t i = jpeg.size() / 2; i < jpeg.size() / 2 + 40; ++i) scratched[i] = '\x5A';
  std::string without_tables = jpeg;
  for (std::size_t i = 5, at = jpeg.find("\xFF\xC4"); i < 20; ++i) without_tables[at + i] = '\x11';

  struct Case {
    std::string what;
    std::string file;
    ImageErrorKind kind;
  };
  const std::vector<Case> cases = {
      {"no such file", path("absent.jpg"), ImageErrorKind::missing},
      {"a folder", path(""), ImageErrorKind::missing},
      {"a text named .jpg", bytes("text.jpg", "not a picture at all\n"), ImageErrorKind::not_an_image},
      {"an empty file", bytes("empty.jpg", ""), ImageErrorKind::truncated},
      {"half a JPEG", bytes("half.jpg", jpeg.substr(0, jpeg.size() / 2)), ImageErrorKind::truncated},
      {"a JPEG without its last byte", bytes("last.jpg", jpeg.substr(0, jpeg.size() - 1)), ImageErrorKind::truncated},
      {"a JPEG's first ten bytes", bytes("ten.jpg", jpeg.substr(0, 10)), ImageErrorKind::truncated},
      {"half a PNG", bytes("half.png", png.substr(0, png.size() / 2)), ImageErrorKind::truncated},
      {"a PNG without its last byte", bytes("last.png", png.substr(0, png.size() - 1)), ImageErrorKind::truncated},
      {"a JPEG with a PNG's body", bytes("mixed.jpg", jpeg.substr(0, 20) + png), ImageErrorKind::truncated},
      {"a JPEG with a scratch", bytes("scratched.jpg", scratched), ImageErrorKind::damaged},
      {"a JPEG without its tables", bytes("tables.jpg", without_tables), ImageErrorKind::damaged},
      {"a PNG with scrambled chunks", bytes("damaged.png", damaged), ImageErrorKind::damaged},
      {"one channel", encoded("grey.png", pattern(CV_8UC1)), ImageErrorKind::wrong_format},
      {"one channel, JPEG", encoded("grey.jpg", pattern(CV_8UC1)), ImageErrorKind::wrong_format},
      {"transparency", encoded("alpha.png", pattern(CV_8UC4)), ImageErrorKind::wrong_format},
      {"16 bits", encoded("deep.png", pattern(CV_16UC3)), ImageErrorKind::wrong_format},
      {"another size", encoded("small.png", pattern(CV_8UC3)(cv::Rect(0, 0, 32, 48))), ImageErrorKind::wrong_size},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const LoadedImage loaded = load_image(c.file, size);
    EXPECT_TRUE(loaded.bgr.empty());
    if (!loaded.error) {
      ADD_FAILURE() << "was accepted";
      continue;
    }
    EXPECT_EQ(loaded.error->kind, c.kind) << loaded.error->message();
    EXPECT_THAT(loaded.error->message(), testing::StartsWith(c.file + ": "));
    EXPECT_THAT(loaded.error->message(), testing::Not(testing::HasSubstr("\n")));
  }
}

TEST_F(ImageFile, AJpegsThumbnailDoesNotMakeUpForItsMissingEnd) {
  const std::string jpeg = content(encoded("whole.jpg", pattern(CV_8UC3)));
  // An application segment (FF E1) with an end-of-image marker in it, before a scan that is cut off.
  const std::string segment("\xFF\xE1\x00\x06\xFF\xD9\xFF\xD9", 8);
  const std::string cut = jpeg.substr(0, 2) + segment + jpeg.substr(2, jpeg.size() / 2);
  const LoadedImage loaded = load_image(bytes("thumbnail.jpg", cut), size);
  ASSERT_TRUE(loaded.error);
  EXPECT_EQ(loaded.error->kind, ImageErrorKind::truncated);
}

TEST_F(ImageFile, WhatCannotBeWrittenIsSaid) {
  EXPECT_THAT(*write_png(path("a.png"), cv::Mat()), testing::HasSubstr("a.png"));
  bytes("file", "x");
  EXPECT_THAT(*write_png(path("file/a.png"), pattern(CV_8UC3)), testing::HasSubstr("file/a.png"));
  EXPECT_TRUE(write_png("/proc/nowhere.png", pattern(CV_8UC3)).has_value());
}

}  // namespace
}  // namespace hogline::hw::files
