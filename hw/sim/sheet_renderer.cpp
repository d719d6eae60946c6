#include "hw/sim/sheet_renderer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <thread>

#include "hw/sim/ice_tile.hpp"
#include "hw/sim/light_field.hpp"
#include "hw/sim/sensor.hpp"
#include "hw/sim/sheet_paint.hpp"
#include "hw/sim/solids.hpp"

namespace hogline::hw::sim {
namespace {

constexpr int tile_w = RayTable::tile_width;
constexpr int tile_h = RayTable::tile_height;
constexpr float off_surface_m = 0.06F;  // paint's place less the surface's, at most

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

// The part of the sheet that a tile may show, with what blur brings in from outside.
struct Reach {
  float x0 = -1e9F, x1 = 1e9F, y0 = -1e9F, y1 = 1e9F;
  bool meets(const PaintedRect& r, float margin) const {
    return r.x1_m + margin >= x0 && r.x0_m - margin <= x1 && r.y1_m + margin >= y0 && r.y0_m - margin <= y1;
  }
  void include(const Reach& o) {
    x0 = std::min(x0, o.x0);
    x1 = std::max(x1, o.x1);
    y0 = std::min(y0, o.y0);
    y1 = std::max(y1, o.y1);
  }
};

// A stone or person and the cone in which the camera sees it.
struct Seen {
  Solid solid;
  Eigen::Vector3f towards;  // in c
  float cosine, sine;       // of the cone's half angle
};

// A tile's own cone.
struct TileCone {
  Eigen::Vector3f towards;
  float cosine, sine;
  bool meets(const Seen& s) const { return towards.dot(s.towards) >= cosine * s.cosine - sine * s.sine; }
};

// Eight rows of light, plane by plane.
struct Strip {
  int stride;
  std::vector<float> light;
  explicit Strip(int width) : stride(width), light(static_cast<std::size_t>(3 * tile_h * width)) {}
  float* row(int plane, int j) { return &light[static_cast<std::size_t>((plane * tile_h + j) * stride)]; }
};

struct Shape {
  const PaintedHouse* house;
  int first_ring;  // of those whose edge may be in the tile
  int rings;
};

// All that belongs to one exposure and is the same for all its tiles.
struct Scene {
  IceView view;
  std::vector<PaintedRect> raised;
  std::vector<Seen> solids;
  std::vector<StoneLook> stones;
};

}  // namespace

struct SheetRenderer::Impl {
  Impl(const vision::Intrinsics& intrinsics, const vision::Ice& the_ice, const RinkAppearance& the_rink,
       const SensorModel& sensor_model, std::uint64_t seed, int thread_count)
      : lens(intrinsics),
        ice(the_ice),
        rink(the_rink),
        rays(lens),
        paint(sheet_paint(rink.sheet)),
        hall(rink.hall, paint.bounds),
        sensor(sensor_model, seed, intrinsics.width_px),
        field(rays, intrinsics, rink.light, hall),
        edge_variance(static_cast<float>(1.0 / 12.0 + sensor_model.blur_sigma_px * sensor_model.blur_sigma_px)),
        threads(thread_count) {
    assert(thread_count >= 1);
    for (int j = 0; j < rays.tiles_down(); ++j) {
      for (int i = 0; i < rays.tiles_across(); ++i) cones.push_back(cone(i, j));
    }
  }

  TileCone cone(int i, int j) const;
  Scene look(const Exposure& exposure);
  template <typename Sink>
  void draw(const Exposure& exposure, const Sink& sink);
  void draw_strip(const Scene& scene, int j, Strip& strip, IceTile& tile) const;
  Reach reach(int i, int j) const;
  Colour ground(float x, float y) const;
  bool paint_tile(const Scene& scene, int i, int j, const Reach& strip_reach, bool all_ice, IceTile& tile,
                  Colour& plain) const;
  bool paint_houses(const Reach& at, IceTile& tile, bool dry_run) const;
  void lay_ice(int i, int j, const IceTile* tile, const Colour& plain, Strip& strip) const;
  bool lay_plain_hall(const Scene& scene, int i, int j, Strip& strip) const;
  void lay_solids(const Scene& scene, int i, int j, const std::vector<const Seen*>& near, bool with_hall, Strip& strip) const;
  Ray ray_at(const Scene& scene, const Eigen::Vector3f& c) const;

  vision::Lens lens;
  vision::Ice ice;
  RinkAppearance rink;
  RayTable rays;
  SheetPaint paint;
  Hall hall;
  Sensor sensor;
  LightField field;
  std::vector<TileCone> cones;
  float edge_variance;
  int threads;
};

TileCone SheetRenderer::Impl::cone(int i, int j) const {
  TileCone c{Eigen::Vector3f::Zero(), 1.0F, 0.0F};
  std::array<Eigen::Vector3f, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const auto r = field.ray(field.corner(i + k % 2, j + k / 2));
    corners[static_cast<std::size_t>(k)] = Eigen::Vector3f(r.x, r.y, r.z).normalized();
    c.towards += corners[static_cast<std::size_t>(k)];
  }
  c.towards.normalize();
  for (const auto& corner : corners) c.cosine = std::min(c.cosine, corner.dot(c.towards));
  c.sine = std::sqrt(std::max(0.0F, 1.0F - c.cosine * c.cosine));
  return c;
}

Scene SheetRenderer::Impl::look(const Exposure& exposure) {
  assert(vision::is_finite(exposure.eMc));
  const double half_s = 0.5 * exposure.duration_s;
  const bool moving = half_s > 0.0 && (exposure.velocity.linear.norm() > 0.0 || exposure.velocity.angular.norm() > 0.0);
  Scene scene;
  scene.view = IceView(exposure.eMc, ice);
  field.look(scene.view, moving ? IceView(moved(exposure, -half_s), ice) : scene.view,
             moving ? IceView(moved(exposure, half_s), ice) : scene.view, moving);
  scene.raised = seen_dividers(paint, rink.sheet, exposure.eMc.translation().x(), exposure.eMc.translation().z());
  scene.stones = exposure.stones;

  const Eigen::Matrix3f cRe = exposure.eMc.linear().transpose().cast<float>();
  const Eigen::Vector3f eye = exposure.eMc.translation().cast<float>();
  const auto add = [&](const Solid& solid) {
    const Eigen::Vector3f to = cRe * (solid.centre() - eye);
    const float sine = std::min(0.99F, solid.radius_m() / std::max(0.01F, to.norm()));
    scene.solids.push_back({solid, to.normalized(), std::sqrt(1.0F - sine * sine), sine});
  };
  for (const StoneLook& stone : exposure.stones) add(Solid::stone(stone));
  for (const PersonLook& person : exposure.people) add(Solid::person(person));
  return scene;
}

Reach SheetRenderer::Impl::reach(int i, int j) const {
  Reach r{1e9F, -1e9F, 1e9F, -1e9F};
  Smear smear;
  for (int k = 0; k < 4; ++k) {
    const std::size_t c = field.corner(i + k % 2, j + k / 2);
    r.include({field.paint_x(c), field.paint_x(c), field.paint_y(c), field.paint_y(c)});
    smear.x_m = std::max(smear.x_m, std::abs(field.smear(c).x_m));
    smear.y_m = std::max(smear.y_m, std::abs(field.smear(c).y_m));
  }
  // Half an edge's width in pixels, as a share of the tile's smaller side, and half as much again for perspective.
  const float share = 1.5F * (0.5F * std::sqrt(20.0F * edge_variance) + 1.0F) / static_cast<float>(tile_h);
  const float grow_x = share * (r.x1 - r.x0) + smear.x_m;
  const float grow_y = share * (r.y1 - r.y0) + smear.y_m;
  return {r.x0 - grow_x, r.x1 + grow_x, r.y0 - grow_y, r.y1 + grow_y};
}

Colour SheetRenderer::Impl::ground(float x, float y) const {
  for (const PaintedHouse& house : paint.houses) {
    const float r = std::hypot(x - house.x_m, y - house.y_m);
    for (std::size_t ring = 4; ring-- > 0;) {
      if (r < house.radii_m[ring]) return rink.sheet.rings[ring];
    }
  }
  return rink.sheet.ice;
}

// Paints the rings whose edges may be in the tile; a dry run only says whether there are any.
bool SheetRenderer::Impl::paint_houses(const Reach& at, IceTile& tile, bool dry_run) const {
  bool any = false;
  for (const PaintedHouse& house : paint.houses) {
    const float dx0 = std::max({at.x0 - house.x_m, house.x_m - at.x1, 0.0F});
    const float dy0 = std::max({at.y0 - house.y_m, house.y_m - at.y1, 0.0F});
    const float dx1 = std::max(std::abs(at.x0 - house.x_m), std::abs(at.x1 - house.x_m));
    const float dy1 = std::max(std::abs(at.y0 - house.y_m), std::abs(at.y1 - house.y_m));
    const float nearest = std::hypot(dx0, dy0);
    const float farthest = std::hypot(dx1, dy1);
    if (nearest > house.radii_m[0]) continue;
    for (std::size_t ring = 0; ring < 4; ++ring) {
      const bool edge = nearest <= house.radii_m[ring] && farthest >= house.radii_m[ring];
      if (edge && dry_run) return true;
      // Rings that fill the tile are painted too: the next edge is drawn on them.
      if (!dry_run && nearest <= house.radii_m[ring]) {
        tile.paint_disc(house.x_m, house.y_m, house.radii_m[ring], rink.sheet.rings[ring]);
      }
      any = any || edge;
    }
  }
  return any;
}

// True: the tile's pixels differ. False: it is all of the colour `plain`.
bool SheetRenderer::Impl::paint_tile(const Scene& scene, int i, int j, const Reach& strip_reach, bool all_ice,
                                     IceTile& tile, Colour& plain) const {
  const Reach at = all_ice ? reach(i, j) : strip_reach;
  const bool rings = paint_houses(at, tile, true);
  const auto seen = [&at](float margin) { return [&at, margin](const PaintedRect& r) { return at.meets(r, margin); }; };
  const auto dark = [&at](const StoneLook& s) {
    const auto x = static_cast<float>(s.x_m), y = static_cast<float>(s.y_m), r = 2.0F * static_cast<float>(s.radius_m);
    return x + r >= at.x0 && x - r <= at.x1 && y + r >= at.y0 && y - r <= at.y1;
  };
  const bool lines = std::any_of(paint.rects.begin(), paint.rects.end(), seen(0.0F));
  const float wide = off_surface_m + static_cast<float>(rink.sheet.rope_sway_m);
  const bool raised = std::any_of(scene.raised.begin(), scene.raised.end(), seen(wide));
  const bool shaded = std::any_of(scene.stones.begin(), scene.stones.end(), dark);
  const std::size_t a = field.corner(i, j), b = field.corner(i + 1, j + 1);
  plain = ground(0.5F * (field.paint_x(a) + field.paint_x(b)), 0.5F * (field.paint_y(a) + field.paint_y(b)));
  if (all_ice && !rings && !lines && !raised && !shaded) return false;

  const Smear sa = field.smear(a), sb = field.smear(b);
  tile.aim(scene.view, rays, i * tile_w, j * tile_h, {0.5F * (sa.x_m + sb.x_m), 0.5F * (sa.y_m + sb.y_m)}, edge_variance);
  tile.fill(rings ? rink.sheet.ice : plain);
  if (rings) paint_houses(at, tile, false);
  const auto draw = [&](const PaintedRect& r, bool on_surface) {
    const bool ends_x = r.x0_m + wide >= at.x0 || r.x1_m - wide <= at.x1;
    const bool ends_y = r.y0_m >= at.y0 || r.y1_m <= at.y1;
    tile.paint_rect(r, on_surface, ends_x, ends_y);
  };
  for (const PaintedRect& r : paint.rects) {
    if (lines && at.meets(r, 0.0F)) draw(r, false);
  }
  for (const StoneLook& s : scene.stones) {
    if (shaded && dark(s)) {
      tile.shade(static_cast<float>(s.x_m), static_cast<float>(s.y_m), 1.6F * static_cast<float>(s.radius_m), 0.7F);
    }
  }
  for (const PaintedRect& r : scene.raised) {
    if (raised && at.meets(r, wide)) draw(r, true);
  }
  return true;
}

void SheetRenderer::Impl::lay_ice(int i, int j, const IceTile* tile, const Colour& plain, Strip& strip) const {
  const std::size_t c00 = field.corner(i, j), c10 = field.corner(i + 1, j), c01 = field.corner(i, j + 1),
                    c11 = field.corner(i + 1, j + 1);
  const std::array<const float*, 3> planes =
      tile != nullptr ? std::array{tile->red(), tile->green(), tile->blue()} : std::array<const float*, 3>{};
  const std::array colour{plain.red, plain.green, plain.blue};
  for (int y = 0; y < tile_h; ++y) {
    const float down = (static_cast<float>(y) + 0.5F) / tile_h;
    const auto between = [down](float top, float bottom) { return top + down * (bottom - top); };
    const float light0 = between(field.on_ice_light(c00), field.on_ice_light(c01));
    const float light_step = (between(field.on_ice_light(c10), field.on_ice_light(c11)) - light0) / tile_w;
    const float gloss0 = between(field.gloss(c00), field.gloss(c01));
    const float gloss_step = (between(field.gloss(c10), field.gloss(c11)) - gloss0) / tile_w;
    for (std::size_t p = 0; p < 3; ++p) {
      float* out = strip.row(static_cast<int>(p), y) + i * tile_w;
      if (tile == nullptr) {
        const float base = colour[p] * light0 + gloss0, slope = colour[p] * light_step + gloss_step;
        for (int x = 0; x < tile_w; ++x) out[x] = base + slope * (static_cast<float>(x) + 0.5F);
        continue;
      }
      const float* albedo = planes[p] + y * tile_w;
      for (int x = 0; x < tile_w; ++x) {
        const float along = static_cast<float>(x) + 0.5F;
        out[x] = albedo[x] * (light0 + light_step * along) + gloss0 + gloss_step * along;
      }
    }
  }
}

Ray SheetRenderer::Impl::ray_at(const Scene& scene, const Eigen::Vector3f& c) const {
  const auto& r = scene.view.eRc;
  return {{scene.view.x_m, scene.view.y_m, scene.view.height_m},
          {r[0] * c.x() + r[1] * c.y() + r[2] * c.z(), r[3] * c.x() + r[4] * c.y() + r[5] * c.z(),
           r[6] * c.x() + r[7] * c.y() + r[8] * c.z()}};
}

// A tile of one wall: true, and it is laid. False: something ends in it.
bool SheetRenderer::Impl::lay_plain_hall(const Scene& scene, int i, int j, Strip& strip) const {
  std::array<Hall::View, 4> views{};
  const auto corner_ray = [&](int k) {
    const auto r = field.ray(field.corner(i + k % 2, j + k / 2));
    return Eigen::Vector3f(r.x, r.y, r.z);
  };
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (int k = 0; k < 4; ++k) {
    const auto view = hall.look(ray_at(scene, corner_ray(k)));
    if (!view || (k > 0 && view->material != views[0].material)) return false;
    views[static_cast<std::size_t>(k)] = *view;
    middle += 0.25F * corner_ray(k);
  }
  for (const Eigen::Vector3f& inner :
       {middle, Eigen::Vector3f(0.5F * (corner_ray(0) + corner_ray(1))), Eigen::Vector3f(0.5F * (corner_ray(2) + corner_ray(3))),
        Eigen::Vector3f(0.5F * (corner_ray(0) + corner_ray(2))), Eigen::Vector3f(0.5F * (corner_ray(1) + corner_ray(3)))}) {
    const auto view = hall.look(ray_at(scene, inner));
    if (!view || view->material != views[0].material) return false;
  }
  const float light = field.in_hall_light(field.corner(i, j));
  for (int y = 0; y < tile_h; ++y) {
    const float down = (static_cast<float>(y) + 0.5F) / tile_h;
    for (int p = 0; p < 3; ++p) {
      const auto part = [&](std::size_t k) {
        const Colour& c = views[k].colour;
        return light * (p == 0 ? c.red : p == 1 ? c.green : c.blue);
      };
      const float left = part(0) + down * (part(2) - part(0));
      const float slope = (part(1) + down * (part(3) - part(1)) - left) / tile_w;
      float* out = strip.row(p, y) + i * tile_w;
      for (int x = 0; x < tile_w; ++x) out[x] = left + slope * (static_cast<float>(x) + 0.5F);
    }
  }
  return true;
}

// Solids and hall over the ice: looked at along the rays between the pixels, each pixel the mean of its four.
void SheetRenderer::Impl::lay_solids(const Scene& scene, int i, int j, const std::vector<const Seen*>& near, bool with_hall,
                                     Strip& strip) const {
  struct Sample {
    float red, green, blue, solid;
  };
  std::array<Sample, (tile_w + 1) * (tile_h + 1)> samples;
  const float light = field.in_hall_light(field.corner(i, j));
  for (int y = 0; y <= tile_h; ++y) {
    for (int x = 0; x <= tile_w; ++x) {
      const int u = i * tile_w + x - 1, v = j * tile_h + y - 1;
      const auto mean = [](const float* top, const float* bottom) { return 0.25F * (top[0] + top[1] + bottom[0] + bottom[1]); };
      const Ray ray = ray_at(scene, {mean(rays.x(u, v), rays.x(u, v + 1)), mean(rays.y(u, v), rays.y(u, v + 1)),
                                     mean(rays.z(u, v), rays.z(u, v + 1))});
      std::optional<Hit> nearest;
      for (const Seen* seen : near) {
        const auto hit = seen->solid.meet(ray);
        if (hit && (!nearest || hit->distance < nearest->distance)) nearest = hit;
      }
      if (!nearest && with_hall) {
        if (const auto view = hall.look(ray)) nearest = Hit{0.0F, view->colour};
      }
      samples[static_cast<std::size_t>(y * (tile_w + 1) + x)] =
          nearest ? Sample{light * nearest->colour.red, light * nearest->colour.green, light * nearest->colour.blue, 1.0F}
                  : Sample{0.0F, 0.0F, 0.0F, 0.0F};
    }
  }
  for (int y = 0; y < tile_h; ++y) {
    float* red = strip.row(0, y) + i * tile_w;
    float* green = strip.row(1, y) + i * tile_w;
    float* blue = strip.row(2, y) + i * tile_w;
    for (int x = 0; x < tile_w; ++x) {
      const Sample* top = &samples[static_cast<std::size_t>(y * (tile_w + 1) + x)];
      const Sample* bottom = top + tile_w + 1;
      const auto mean = [top, bottom](float Sample::*part) {
        return 0.25F * (top[0].*part + top[1].*part + bottom[0].*part + bottom[1].*part);
      };
      const float through = 1.0F - mean(&Sample::solid);
      red[x] = through * red[x] + mean(&Sample::red);
      green[x] = through * green[x] + mean(&Sample::green);
      blue[x] = through * blue[x] + mean(&Sample::blue);
    }
  }
}

void SheetRenderer::Impl::draw_strip(const Scene& scene, int j, Strip& strip, IceTile& tile) const {
  std::vector<const Seen*> near;
  for (int i = 0; i < rays.tiles_across(); ++i) {
    int on_ice = 0;
    for (int k = 0; k < 4; ++k) on_ice += field.on_ice(field.corner(i + k % 2, j + k / 2)) ? 1 : 0;

    const bool hall_only = on_ice == 0;
    const bool hall_laid = hall_only && lay_plain_hall(scene, i, j, strip);
    if (!hall_laid) {
      Colour plain;
      const bool varied = paint_tile(scene, i, j, Reach{}, on_ice == 4, tile, plain);
      lay_ice(i, j, varied ? &tile : nullptr, plain, strip);
    }

    near.clear();
    const TileCone& cone_ij = cones[static_cast<std::size_t>(j * rays.tiles_across() + i)];
    for (const Seen& seen : scene.solids) {
      if (cone_ij.meets(seen)) near.push_back(&seen);
    }
    const bool with_hall = on_ice < 4 && !hall_laid;
    if (with_hall || !near.empty()) lay_solids(scene, i, j, near, with_hall, strip);
  }
}

template <typename Sink>
void SheetRenderer::Impl::draw(const Exposure& exposure, const Sink& sink) {
  const Scene scene = look(exposure);
  const auto work = [&](int first) {
    Strip strip(rays.tiles_across() * tile_w);
    IceTile tile;
    for (int j = first; j < rays.tiles_down(); j += threads) {
      draw_strip(scene, j, strip, tile);
      sink(j * tile_h, std::min(tile_h, lens.intrinsics().height_px - j * tile_h), strip);
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
  const auto& size = impl_->lens.intrinsics();
  bgr.create(size.height_px, size.width_px, CV_8UC3);
  impl_->draw(exposure, [&](int first_row, int rows, Strip& strip) {
    thread_local std::vector<std::uint16_t> scratch;
    for (int y = 0; y < rows; ++y) {
      impl_->sensor.expose(strip.row(0, y), strip.row(1, y), strip.row(2, y), frame_seed, first_row + y,
                           bgr.ptr<std::uint8_t>(first_row + y), scratch);
    }
  });
}

void SheetRenderer::render_light(const Exposure& exposure, cv::Mat& bgr) const {
  const auto& size = impl_->lens.intrinsics();
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
