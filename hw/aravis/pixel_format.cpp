#include "hw/aravis/pixel_format.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace hogline::hw::pfnc {
namespace {

constexpr int no_conversion = -1;

struct Format {
  std::uint32_t number;
  const char* name;
  int channels;
  int to_bgr;  ///< OpenCV names a Bayer pattern by its second row's second and third pixel, PFNC by the first two
};

constexpr std::array<Format, 7> formats{{
    {mono8, "Mono8", 1, no_conversion},
    {bgr8, "BGR8", 3, no_conversion},
    {rgb8, "RGB8", 3, cv::COLOR_RGB2BGR},
    {bayer_rg8, "BayerRG8", 1, cv::COLOR_BayerBG2BGR},
    {bayer_bg8, "BayerBG8", 1, cv::COLOR_BayerRG2BGR},
    {bayer_gr8, "BayerGR8", 1, cv::COLOR_BayerGB2BGR},
    {bayer_gb8, "BayerGB8", 1, cv::COLOR_BayerGR2BGR},
}};

const Format* find(std::uint32_t number) {
  const auto at = std::find_if(formats.begin(), formats.end(), [=](const Format& f) { return f.number == number; });
  return at == formats.end() ? nullptr : &*at;
}

}  // namespace

std::string name(std::uint32_t format) {
  if (const Format* known = find(format)) return known->name;
  char text[16];
  std::snprintf(text, sizeof(text), "0x%08X", format);
  return text;
}

std::optional<cv::Mat> to_picture(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                                  std::uint32_t format) {
  const Format* known = find(format);
  if (known == nullptr || width_px <= 0 || height_px <= 0) return std::nullopt;
  const auto needed = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                      static_cast<std::size_t>(known->channels);
  if (bytes.size() < needed) return std::nullopt;

  // OpenCV has no Mat of constant memory; it is only read from here.
  const cv::Mat raw(height_px, width_px, CV_8UC(known->channels), const_cast<std::uint8_t*>(bytes.data()));
  if (known->to_bgr == no_conversion) return raw.clone();
  cv::Mat bgr;
  cv::cvtColor(raw, bgr, known->to_bgr);
  return bgr;
}

}  // namespace hogline::hw::pfnc
