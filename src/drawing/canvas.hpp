// Lines, discs and text at any place of a picture, not only whole pixels; the same calls give the same bytes.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hogline::drawing {

/// 8 bits each.
struct Ink {
  int red = 0;
  int green = 0;
  int blue = 0;
};

/// The inks of every drawing: told apart by people who do not see all colours, too (Okabe and Ito 2008).
namespace inks {
inline constexpr Ink paper{255, 255, 255};
inline constexpr Ink text{38, 42, 48};
inline constexpr Ink faint{150, 156, 164};
inline constexpr Ink grid{228, 231, 235};
inline constexpr Ink blue{0, 114, 178};
inline constexpr Ink orange{230, 140, 0};
inline constexpr Ink green{0, 158, 115};
inline constexpr Ink red{206, 62, 36};
inline constexpr Ink purple{170, 80, 150};
inline constexpr Ink sky{86, 180, 233};
inline constexpr Ink yellow{245, 200, 20};
}  // namespace inks

enum class Anchor { left, centre, right };

struct TextStyle {
  Anchor anchor = Anchor::left;
  bool bold = false;
  std::optional<Ink> halo;  ///< a border around the letters, to be read over anything
};

/// Coordinates are in pixels of the finished picture, x right, y down, pixel centres at integers. What is not finite or
/// further than a million pixels away is not drawn.
class Canvas {
 public:
  /// An empty sheet of paper.
  Canvas(cv::Size size, const Ink& paper);
  /// Draws on a copy of a CV_8UC3 or CV_8UC1 picture.
  explicit Canvas(const cv::Mat& picture);

  cv::Size size() const { return size_; }

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Ink& ink, double width_px);
  /// Joined points; a point that is not finite makes a gap. `dash_px` 0 is a full line.
  void poly_line(const std::vector<Eigen::Vector2d>& points, const Ink& ink, double width_px, double dash_px = 0.0);
  void disc(const Eigen::Vector2d& centre, double radius_px, const Ink& ink);
  void circle(const Eigen::Vector2d& centre, double radius_px, const Ink& ink, double width_px);
  void polygon(const std::vector<Eigen::Vector2d>& corners, const Ink& ink, double opacity = 1.0);
  void box(const Eigen::Vector2d& corner, const Eigen::Vector2d& opposite, const Ink& ink, double opacity = 1.0);

  /// Text with its capitals `height_px` high, its baseline starting, centred or ending at `at`. ASCII only.
  void text(const Eigen::Vector2d& at, const std::string& words, double height_px, const Ink& ink,
            const TextStyle& style = {});
  /// Text from the bottom to the top, centred at `at`.
  void upright_text(const Eigen::Vector2d& at, const std::string& words, double height_px, const Ink& ink);
  static double text_width_px(const std::string& words, double height_px);

  /// The finished picture, CV_8UC3.
  cv::Mat picture() const;

 private:
  bool drawable(const Eigen::Vector2d& p) const;
  cv::Point fixed(const Eigen::Vector2d& p) const;
  int thickness(double width_px) const;

  cv::Size size_;
  int oversampling_;
  cv::Mat sheet_;
};

}  // namespace hogline::drawing
