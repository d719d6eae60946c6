#include "src/drawing/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace hogline::drawing {
namespace {

constexpr int fraction_bits = 4;
constexpr double far_px = 1e6;
constexpr int font = cv::FONT_HERSHEY_DUPLEX;
constexpr double capitals_at_scale_1_px = 21.0;

cv::Scalar colour(const Ink& ink) {
  return {static_cast<double>(ink.blue), static_cast<double>(ink.green), static_cast<double>(ink.red)};
}

cv::Mat in_colour(const cv::Mat& picture) {
  cv::Mat bgr;
  if (picture.channels() == 1) {
    cv::cvtColor(picture, bgr, cv::COLOR_GRAY2BGR);
  } else {
    bgr = picture.clone();
  }
  return bgr;
}

}  // namespace

// Drawn twice as large and averaged: thin lines and small letters come out even.
Canvas::Canvas(cv::Size size, const Ink& paper)
    : size_(size), oversampling_(2), sheet_(size * oversampling_, CV_8UC3, colour(paper)) {}

Canvas::Canvas(const cv::Mat& picture) : size_(picture.size()), oversampling_(1), sheet_(in_colour(picture)) {}

bool Canvas::drawable(const Eigen::Vector2d& p) const { return p.allFinite() && p.cwiseAbs().maxCoeff() < far_px; }

cv::Point Canvas::fixed(const Eigen::Vector2d& p) const {
  const double scale = oversampling_ * (1 << fraction_bits);
  const double half = 0.5 * (oversampling_ - 1) * (1 << fraction_bits);
  return {static_cast<int>(std::lround(scale * p.x() + half)), static_cast<int>(std::lround(scale * p.y() + half))};
}

int Canvas::thickness(double width_px) const {
  return std::max(1, static_cast<int>(std::lround(width_px * oversampling_)));
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Ink& ink, double width_px) {
  if (!drawable(from) || !drawable(to)) return;
  cv::line(sheet_, fixed(from), fixed(to), colour(ink), thickness(width_px), cv::LINE_AA, fraction_bits);
}

void Canvas::poly_line(const std::vector<Eigen::Vector2d>& points, const Ink& ink, double width_px, double dash_px) {
  double travelled = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d& a = points[i - 1];
    const Eigen::Vector2d& b = points[i];
    if (!drawable(a) || !drawable(b)) continue;
    if (dash_px <= 0.0) {
      line(a, b, ink, width_px);
      continue;
    }
    const double length = (b - a).norm();
    for (double at = 0.0; at < length;) {
      const double in_dash = std::fmod(travelled + at, 2.0 * dash_px);
      const bool drawn = in_dash < dash_px;
      const double next = std::min(length, at + std::max(0.01, (drawn ? dash_px : 2.0 * dash_px) - in_dash));
      if (drawn) line(a + at / length * (b - a), a + next / length * (b - a), ink, width_px);
      at = next;
    }
    travelled += length;
  }
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius_px, const Ink& ink) {
  if (!drawable(centre) || !(radius_px > 0.0) || radius_px > far_px) return;
  const int radius = static_cast<int>(std::lround(radius_px * oversampling_ * (1 << fraction_bits)));
  cv::circle(sheet_, fixed(centre), radius, colour(ink), cv::FILLED, cv::LINE_AA, fraction_bits);
}

void Canvas::circle(const Eigen::Vector2d& centre, double radius_px, const Ink& ink, double width_px) {
  if (!drawable(centre) || !(radius_px > 0.0) || radius_px > far_px) return;
  const int radius = static_cast<int>(std::lround(radius_px * oversampling_ * (1 << fraction_bits)));
  cv::circle(sheet_, fixed(centre), radius, colour(ink), thickness(width_px), cv::LINE_AA, fraction_bits);
}

void Canvas::polygon(const std::vector<Eigen::Vector2d>& corners, const Ink& ink, double opacity) {
  std::vector<cv::Point> fixed_corners;
  for (const auto& corner : corners) {
    if (!drawable(corner)) return;
    fixed_corners.push_back(fixed(corner));
  }
  if (fixed_corners.size() < 3) return;
  if (opacity >= 1.0) {
    cv::fillPoly(sheet_, std::vector<std::vector<cv::Point>>{fixed_corners}, colour(ink), cv::LINE_AA, fraction_bits);
    return;
  }
  cv::Rect around;
  for (const cv::Point& p : fixed_corners) {
    const cv::Rect one(p.x / (1 << fraction_bits) - 2, p.y / (1 << fraction_bits) - 2, 4, 4);
    around = around.empty() ? one : around | one;
  }
  around &= cv::Rect({}, sheet_.size());
  if (around.empty()) return;
  const cv::Mat under = sheet_(around).clone();
  cv::fillPoly(sheet_, std::vector<std::vector<cv::Point>>{fixed_corners}, colour(ink), cv::LINE_AA, fraction_bits);
  cv::Mat part = sheet_(around);
  cv::addWeighted(part, opacity, under, 1.0 - opacity, 0.0, part);
}

void Canvas::box(const Eigen::Vector2d& corner, const Eigen::Vector2d& opposite, const Ink& ink, double opacity) {
  polygon({corner, {opposite.x(), corner.y()}, opposite, {corner.x(), opposite.y()}}, ink, opacity);
}

double Canvas::text_width_px(const std::string& words, double height_px) {
  int below = 0;
  constexpr double fine = 8.0;  // sizes come in whole pixels: ask at a large scale
  const cv::Size size = cv::getTextSize(words, font, fine, 1, &below);
  return size.width * height_px / (capitals_at_scale_1_px * fine);
}

void Canvas::text(const Eigen::Vector2d& at, const std::string& words, double height_px, const Ink& ink,
                  const TextStyle& style) {
  if (!drawable(at)) return;
  const double width = text_width_px(words, height_px);
  const double back = style.anchor == Anchor::left ? 0.0 : style.anchor == Anchor::centre ? 0.5 * width : width;
  const cv::Point corner(static_cast<int>(std::lround((at.x() - back) * oversampling_)),
                         static_cast<int>(std::lround(at.y() * oversampling_)));
  const double scale = height_px * oversampling_ / capitals_at_scale_1_px;
  const double stroke = height_px * (style.bold ? 0.13 : 0.075);
  if (style.halo) {
    const int border = thickness(stroke + 0.4 * height_px);
    cv::putText(sheet_, words, corner, font, scale, colour(*style.halo), border, cv::LINE_AA);
  }
  cv::putText(sheet_, words, corner, font, scale, colour(ink), thickness(stroke), cv::LINE_AA);
}

void Canvas::upright_text(const Eigen::Vector2d& at, const std::string& words, double height_px, const Ink& ink) {
  if (!drawable(at)) return;
  const int width = static_cast<int>(std::lround((text_width_px(words, height_px) + 8.0) * oversampling_));
  const int height = static_cast<int>(std::lround(2.0 * height_px * oversampling_));
  cv::Mat lying(height, width, CV_8UC1, cv::Scalar(0));
  const double scale = height_px * oversampling_ / capitals_at_scale_1_px;
  cv::putText(lying, words, {4 * oversampling_, static_cast<int>(1.5 * height_px * oversampling_)}, font, scale,
              cv::Scalar(255), thickness(0.075 * height_px), cv::LINE_AA);
  cv::Mat standing;
  cv::rotate(lying, standing, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect wanted(static_cast<int>(std::lround(at.x() * oversampling_)) - height / 2,
                        static_cast<int>(std::lround(at.y() * oversampling_)) - width / 2, height, width);
  const cv::Rect seen = wanted & cv::Rect({}, sheet_.size());
  if (seen.empty()) return;
  cv::Mat part = sheet_(seen);
  const cv::Mat mask = standing(seen - wanted.tl());
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.cols; ++x) {
      const double share = mask.at<std::uint8_t>(y, x) / 255.0;
      auto& pixel = part.at<cv::Vec3b>(y, x);
      const cv::Scalar over = colour(ink);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + share * (over[c] - pixel[c]));
    }
  }
}

cv::Mat Canvas::picture() const {
  if (oversampling_ == 1) return sheet_.clone();
  cv::Mat finished;
  cv::resize(sheet_, finished, size_, 0.0, 0.0, cv::INTER_AREA);
  return finished;
}

}  // namespace hogline::drawing
