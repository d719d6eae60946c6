#include "hw/sim/sheet_renderer.hpp"

#include <algorithm>
#include <cassert>
#include <thread>

#include "hw/sim/ice_tile.hpp"
#include "hw/sim/light_field.hpp"
#include "hw/sim/sensor.hpp"
#include "hw/sim/sheet_paint.hpp"
#include "hw/sim/sheet_painter.hpp"
#include "hw/sim/solids.hpp"
#include "hw/sim/solids_painter.hpp"

namespace hogline::hw::sim {
namespace {

constexpr int tile_w = RayTable::tile_width;
constexpr int tile_h = RayTable::tile_height;

// The camera's pose `dt_s` later.
vision::Pose moved(const Exposure& exposure, double dt_s) {
  vision::Pose pose = exposure.eMc;
  pose.translation() += dt_s * exposure.velocity.linear;
  const Eigen::Vector3d turn = dt_s * exposure.velocity.angular;
  if (turn.norm() > 0.0) {
    pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * exposure.eMc.linear();
  }
  return pose;
}

bool moving(const Exposure& exposure) {
  return exposure.duration_s > 0.0 && (exposure.velocity.linear.norm() > 0.0 || exposure.velocity.angular.norm() > 0.0);
}

// All that belongs to one exposure and is the same for all its tiles.
struct Scene {
  IceScene ice;
  std::vector<SeenSolid> solids;
};

}  // namespace

struct SheetRenderer::Impl {
  Impl(const vision::Intrinsics& lens, const vision::Ice& the_ice, const RinkAppearance& the_rink,
       const SensorModel& sensor_model, std::uint64_t seed, int thread_count)
      : intrinsics(lens),
        ice(the_ice),
        rink(the_rink),
        rays(vision::Lens(lens)),
        paint(sheet_paint(rink.sheet)),
        hall(rink.hall, paint.bounds),
        field(rays, intrinsics, rink.light, hall),
        sheet_painter(rink.sheet, paint, rays, field,
                      static_cast<float>(1.0 / 12.0 + sensor_model.blur_sigma_px * sensor_model.blur_sigma_px)),
        solids_painter(hall, rays, field),
        sensor(sensor_model, seed, intrinsics.width_px),
        threads(thread_count) {
    assert(thread_count >= 1);
  }

  Scene look(const Exposure& exposure);
  template <typename Sink>
  void draw(const Exposure& exposure, const Sink& sink);
  void draw_strip(const Scene& scene, int j, PaintDesk& desk, Strip& strip) const;

  vision::Intrinsics intrinsics;
  vision::Ice ice;
  RinkAppearance rink;
  RayTable rays;
  SheetPaint paint;
  Hall hall;
  LightField field;
  SheetPainter sheet_painter;
  SolidsPainter solids_painter;
  Sensor sensor;
  int threads;
};

Scene SheetRenderer::Impl::look(const Exposure& exposure) {
  assert(vision::is_finite(exposure.eMc));
  Scene scene;
  scene.ice.view = IceView(exposure.eMc, ice);
  const bool blurred = moving(exposure);
  const double half_s = 0.5 * exposure.duration_s;
  field.look(scene.ice.view, blurred ? IceView(moved(exposure, -half_s), ice) : scene.ice.view,
             blurred ? IceView(moved(exposure, half_s), ice) : scene.ice.view, blurred);

  const Eigen::Vector3d eye = exposure.eMc.translation();
  scene.ice.dividers = seen_dividers(paint, rink.sheet, eye.x(), eye.z());
  scene.ice.stones = exposure.stones;

  const Eigen::Matrix3f cRe = exposure.eMc.linear().transpose().cast<float>();
  for (const StoneLook& stone : exposure.stones) {
    scene.solids.push_back(seen_from(Solid::stone(stone), eye.cast<float>(), cRe));
  }
  for (const PersonLook& person : exposure.people) {
    scene.solids.push_back(seen_from(Solid::person(person), eye.cast<float>(), cRe));
  }
  return scene;
}

void SheetRenderer::Impl::draw_strip(const Scene& scene, int j, PaintDesk& desk, Strip& strip) const {
  std::vector<const Solid*> near;
  sheet_painter.choose(scene.ice, j, desk);
  for (int i = 0; i < rays.tiles_across(); ++i) {
    int on_ice = 0;
    for (int k = 0; k < 4; ++k) on_ice += field.on_ice(field.corner(i + k % 2, j + k / 2)) ? 1 : 0;

    const bool one_wall = on_ice == 0 && solids_painter.lay_plain_hall(scene.ice.view, i, j, strip);
    if (on_ice > 0) {
      sheet_painter.lay(scene.ice, i, j, desk, strip);
    } else if (!one_wall) {
      sheet_painter.lay_bare(i, j, strip);
    }

    solids_painter.choose(scene.solids, i, j, near);
    const bool with_hall = on_ice < 4 && !one_wall;
    if (with_hall || !near.empty()) solids_painter.lay(scene.ice.view, i, j, near, with_hall, strip);
  }
}

template <typename Sink>
void SheetRenderer::Impl::draw(const Exposure& exposure, const Sink& sink) {
  const Scene scene = look(exposure);
  const auto work = [&](int first) {
    Strip strip(rays.tiles_across() * tile_w);
    PaintDesk desk;
    for (int j = first; j < rays.tiles_down(); j += threads) {
      draw_strip(scene, j, desk, strip);
      sink(j * tile_h, std::min(tile_h, intrinsics.height_px - j * tile_h), strip);
    }
  };
  std::vector<std::thread> helpers;
  for (int k = 1; k < threads; ++k) helpers.emplace_back(work, k);
  work(0);
  for (std::thread& helper : helpers) helper.join();
}

SheetRenderer::SheetRenderer(const vision::Intrinsics& intrinsics, const vision::Ice& ice, const RinkAppearance& rink,
                             const SensorModel& sensor, std::uint64_t seed, int threads)
    : impl_(std::make_unique<Impl>(intrinsics, ice, rink, sensor, seed, threads)) {}
SheetRenderer::~SheetRenderer() = default;
SheetRenderer::SheetRenderer(SheetRenderer&&) noexcept = default;
SheetRenderer& SheetRenderer::operator=(SheetRenderer&&) noexcept = default;

void SheetRenderer::render(const Exposure& exposure, std::uint64_t frame_seed, cv::Mat& bgr) const {
  const auto& size = impl_->intrinsics;
  bgr.create(size.height_px, size.width_px, CV_8UC3);
  impl_->draw(exposure, [&](int first_row, int rows, Strip& strip) {
    thread_local std::vector<std::int32_t> scratch;
    for (int y = 0; y < rows; ++y) {
      impl_->sensor.expose(strip.row(0, y), strip.row(1, y), strip.row(2, y), frame_seed, first_row + y,
                           bgr.ptr<std::uint8_t>(first_row + y), scratch);
    }
  });
}

void SheetRenderer::render_darkness(double light, std::uint64_t frame_seed, cv::Mat& bgr) const {
  const auto& size = impl_->intrinsics;
  bgr.create(size.height_px, size.width_px, CV_8UC3);
  const std::vector<float> row(static_cast<std::size_t>(size.width_px), static_cast<float>(light));
  std::vector<std::int32_t> scratch;
  for (int y = 0; y < size.height_px; ++y) {
    impl_->sensor.expose(row.data(), row.data(), row.data(), frame_seed, y, bgr.ptr<std::uint8_t>(y), scratch);
  }
}

void SheetRenderer::render_light(const Exposure& exposure, cv::Mat& bgr) const {
  const auto& size = impl_->intrinsics;
  bgr.create(size.height_px, size.width_px, CV_32FC3);
  impl_->draw(exposure, [&](int first_row, int rows, Strip& strip) {
    for (int y = 0; y < rows; ++y) {
      auto* out = bgr.ptr<float>(first_row + y);
      for (int x = 0; x < size.width_px; ++x) {
        out[3 * x] = strip.row(2, y)[x];
        out[3 * x + 1] = strip.row(1, y)[x];
        out[3 * x + 2] = strip.row(0, y)[x];
      }
    }
  });
}

}  // namespace hogline::hw::sim
