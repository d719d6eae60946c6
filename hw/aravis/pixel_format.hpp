// Pixel formats by their PFNC numbers (EMVA Pixel Format Naming Convention 2.x), and how they become a picture.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>

namespace hogline::hw::pfnc {

inline constexpr std::uint32_t mono8 = 0x01080001;
inline constexpr std::uint32_t bayer_gr8 = 0x01080008;
inline constexpr std::uint32_t bayer_rg8 = 0x01080009;
inline constexpr std::uint32_t bayer_gb8 = 0x0108000A;
inline constexpr std::uint32_t bayer_bg8 = 0x0108000B;
inline constexpr std::uint32_t rgb8 = 0x02180014;
inline constexpr std::uint32_t bgr8 = 0x02180015;

/// "Mono8", ..., or the number for any other.
std::string name(std::uint32_t format);

/// A picture of its own memory: CV_8UC1 of Mono8, CV_8UC3 in BGR of the others (Bayer: bilinear, no sharpening, no
/// white balance). Nothing when the format is none of the above or the bytes do not fill the picture.
std::optional<cv::Mat> to_picture(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                                  std::uint32_t format);

}  // namespace hogline::hw::pfnc
