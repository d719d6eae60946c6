// hogline_stones_compare [BOARDS]: stones found by hogline, by cv::HoughCircles on the rectified plane of the handles,
// and by plain voting as Yoon et al. describe it (section III.C): recall, precision, error and processor time, on
// random boards with the camera's true pose. The peers' thresholds are those at which they do best on these boards.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/bench/processor_time.hpp"
#include "tests/support/random_board.hpp"
#include "vision/stones.hpp"

namespace {

using hogline::testing::RandomBoard;
using Places = std::vector<Eigen::Vector2d>;

constexpr double least_in_sight = 0.5;  // of its pixels, as tests/vision/stones/board_score.hpp asks
constexpr double cell_m = 0.01;
constexpr double half_width_m = 2.6;
constexpr double near_y_m = -2.5;
constexpr double far_y_m = 6.6;
constexpr double handle_radius_m = 0.095;
constexpr double handle_height_m = 0.125;

hogline::vision::SheetCamera camera_of(const RandomBoard& board) {
  return {hogline::vision::Lens(board.scene.setup.intrinsics), board.scene.eMc, board.scene.setup.ice};
}

Eigen::Vector2d place_of(double column, double row) {
  return {-half_width_m + column * cell_m, far_y_m - row * cell_m};
}

cv::Size plane_size() {
  return {static_cast<int>(2.0 * half_width_m / cell_m), static_cast<int>((far_y_m - near_y_m) / cell_m)};
}

/// The maps from the handles' plane to the picture: once for each camera pose, not counted in the time.
struct Rectification {
  cv::Mat x, y;
  explicit Rectification(const RandomBoard& board) : x(plane_size(), CV_32F), y(plane_size(), CV_32F) {
    const auto camera = camera_of(board);
    for (int r = 0; r < x.rows; ++r) {
      for (int c = 0; c < x.cols; ++c) {
        const Eigen::Vector2d p = place_of(c, r);
        const auto pixel = camera.project({p.x(), p.y(), handle_height_m}).value_or(Eigen::Vector2d(-9.0, -9.0));
        x.at<float>(r, c) = static_cast<float>(pixel.x());
        y.at<float>(r, c) = static_cast<float>(pixel.y());
      }
    }
  }
};

Places by_hough_circles(const cv::Mat& bgr, const Rectification& maps) {
  cv::Mat plane;
  cv::remap(bgr, plane, maps.x, maps.y, cv::INTER_LINEAR);
  cv::cvtColor(plane, plane, cv::COLOR_BGR2GRAY);
  std::vector<cv::Vec3f> circles;
  cv::HoughCircles(plane, circles, cv::HOUGH_GRADIENT, 1.0, 0.25 / cell_m, 80.0, 12.0, 8, 11);
  Places places;
  for (const cv::Vec3f& c : circles) places.push_back(place_of(static_cast<double>(c[0]), static_cast<double>(c[1])));
  return places;
}

// Every edge pixel votes for all centres one handle's radius away from it on the handles' plane.
Places by_plain_votes(const cv::Mat& bgr, const hogline::vision::SheetCamera& camera) {
  cv::Mat grey;
  cv::Mat edges;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Canny(grey, edges, 40.0, 100.0);
  cv::Mat votes(plane_size(), CV_32F, cv::Scalar(0));
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      if (edges.at<std::uint8_t>(y, x) == 0) continue;
      const auto p = camera.plane_at({static_cast<double>(x), static_cast<double>(y)}, handle_height_m);
      if (!p || std::abs(p->x()) > half_width_m || p->y() > far_y_m || p->y() < near_y_m) continue;
      for (int k = 0; k < 60; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 60.0;
        const int c = static_cast<int>((p->x() + handle_radius_m * std::cos(angle) + half_width_m) / cell_m);
        const int r = static_cast<int>((far_y_m - p->y() - handle_radius_m * std::sin(angle)) / cell_m);
        if (c >= 0 && r >= 0 && c < votes.cols && r < votes.rows) votes.at<float>(r, c) += 1.0F;
      }
    }
  }
  cv::GaussianBlur(votes, votes, {}, 1.5);
  // A far handle is few pixels: votes count against the length of its outline in the picture.
  for (int r = 0; r < votes.rows; ++r) {
    const Eigen::Vector2d p = place_of(0.5 * votes.cols, r);
    const auto left = camera.project({p.x() - handle_radius_m, p.y(), handle_height_m});
    const auto right = camera.project({p.x() + handle_radius_m, p.y(), handle_height_m});
    if (left && right) votes.row(r) *= 20.0 / (*right - *left).norm();
  }
  Places places;
  while (true) {
    double most = 0.0;
    cv::Point at;
    cv::minMaxLoc(votes, nullptr, &most, nullptr, &at);
    if (most < 9.0 || places.size() > 60) return places;
    places.push_back(place_of(at.x + 0.5, at.y + 0.5));
    cv::circle(votes, at, static_cast<int>(0.27 / cell_m), cv::Scalar(0), cv::FILLED);
  }
}

Places by_hogline(const cv::Mat& bgr, const RandomBoard& board, hogline::vision::StoneFinder& finder) {
  Places places;
  for (const auto& s : finder.find(bgr, {}, board.scene.eMc, board.scene.sheet_width_m).stones) {
    places.push_back({s.x_m, s.y_m});
  }
  return places;
}

struct Score {
  const char* name;
  int wanted = 0, found = 0, ghosts = 0;
  double squares = 0.0;
  std::vector<double> ms{};

  void add(const RandomBoard& board, Places places, double elapsed_ms) {
    ms.push_back(elapsed_ms);
    for (const auto& s : board.stones) {
      const bool seen = s.in_sight >= least_in_sight;
      const Eigen::Vector2d truth(s.x_m, s.y_m);
      const auto hit = std::find_if(places.begin(), places.end(),
                                    [&](const Eigen::Vector2d& p) { return (p - truth).norm() < 0.12; });
      wanted += seen ? 1 : 0;
      if (hit == places.end()) continue;
      if (seen) ++found;
      if (seen) squares += (*hit - truth).squaredNorm();
      places.erase(hit);
    }
    ghosts += static_cast<int>(places.size());
  }

  void print() {
    std::sort(ms.begin(), ms.end());
    std::printf("| %s | %.1f %% | %.1f %% | %.1f mm | %.1f ms |\n", name, 100.0 * found / std::max(1, wanted),
                100.0 * found / std::max(1, found + ghosts), 1e3 * std::sqrt(squares / std::max(1, found)),
                ms[ms.size() / 2]);
  }
};

template <typename Method>
void run(Score& score, const RandomBoard& board, const Method& method) {
  const double begin = hogline::bench::processor_time_s();
  const Places places = method();
  score.add(board, places, 1e3 * (hogline::bench::processor_time_s() - begin));
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const int boards = argc > 1 ? std::max(1, std::atoi(argv[1])) : 40;
  const int first = argc > 2 ? std::atoi(argv[2]) : 3001;
  Score own{"hogline"};
  Score circles{"cv::HoughCircles, rectified plane"};
  Score plain{"plain voting (Yoon et al.)"};
  int stones = 0;
  for (int seed = first; seed < first + boards; ++seed) {
    const RandomBoard board = hogline::testing::random_board(static_cast<std::uint64_t>(seed));
    const cv::Mat bgr = hogline::testing::render(board.scene);
    const Rectification maps(board);
    hogline::vision::StonesSetup setup;
    setup.camera = board.scene.setup;
    hogline::vision::StoneFinder finder(setup);
    const auto camera = camera_of(board);
    stones += static_cast<int>(board.stones.size());
    run(own, board, [&] { return by_hogline(bgr, board, finder); });
    run(circles, board, [&] { return by_hough_circles(bgr, maps); });
    run(plain, board, [&] { return by_plain_votes(bgr, camera); });
  }
  std::printf("%d boards from %d, %d stones\n\n", boards, first, stones);
  std::printf("| method | recall | precision | error, RMS | median time |\n|---|--:|--:|--:|--:|\n");
  own.print();
  circles.print();
  plain.print();
  return 0;
}
