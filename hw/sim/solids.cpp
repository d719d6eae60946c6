#include "hw/sim/solids.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {
namespace {

struct Contact {
  float distance;
  Eigen::Vector3f normal;
};

std::optional<Contact> meet_ellipsoid(const Eigen::Vector3f& o, const Eigen::Vector3f& d, const Eigen::Vector3f& half) {
  const Eigen::Vector3f so = o.cwiseQuotient(half);
  const Eigen::Vector3f sd = d.cwiseQuotient(half);
  const float a = sd.squaredNorm();
  const float b = so.dot(sd);
  const float c = so.squaredNorm() - 1.0F;
  const float root = b * b - a * c;
  if (root <= 0.0F) return std::nullopt;
  const float t = (-b - std::sqrt(root)) / a;
  if (t <= 0.0F) return std::nullopt;
  return Contact{t, (so + t * sd).cwiseQuotient(half).normalized()};
}

std::optional<Contact> meet_cylinder(const Eigen::Vector3f& o, const Eigen::Vector3f& d, const Eigen::Vector3f& half) {
  const Eigen::Vector2f so = o.head<2>().cwiseQuotient(half.head<2>());
  const Eigen::Vector2f sd = d.head<2>().cwiseQuotient(half.head<2>());
  if (d.z() < 0.0F && o.z() > half.z()) {
    const float t = (half.z() - o.z()) / d.z();
    if ((so + t * sd).squaredNorm() <= 1.0F) return Contact{t, Eigen::Vector3f::UnitZ()};
  }
  const float a = sd.squaredNorm();
  const float b = so.dot(sd);
  const float root = b * b - a * (so.squaredNorm() - 1.0F);
  if (root <= 0.0F || a <= 0.0F) return std::nullopt;
  const float t = (-b - std::sqrt(root)) / a;
  if (t <= 0.0F || std::abs(o.z() + t * d.z()) > half.z()) return std::nullopt;
  const Eigen::Vector2f n = (so + t * sd).cwiseQuotient(half.head<2>());
  return Contact{t, Eigen::Vector3f(n.x(), n.y(), 0.0F).normalized()};
}

std::optional<Contact> meet_box(const Eigen::Vector3f& o, const Eigen::Vector3f& d, const Eigen::Vector3f& half) {
  float enter = 0.0F;
  float leave = 1e9F;
  int face = -1;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0F) {
      if (std::abs(o[i]) > half[i]) return std::nullopt;
      continue;
    }
    const float towards = d[i] > 0.0F ? 1.0F : -1.0F;
    const float first = (-towards * half[i] - o[i]) / d[i];
    if (first > enter) {
      enter = first;
      face = i;
    }
    leave = std::min(leave, (towards * half[i] - o[i]) / d[i]);
  }
  if (face < 0 || enter >= leave) return std::nullopt;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  normal[face] = d[face] > 0.0F ? -1.0F : 1.0F;
  return Contact{enter, normal};
}

// Light from the whole ceiling, and some from the ice below.
float lit(const Eigen::Vector3f& normal) { return 0.60F + 0.40F * normal.z(); }

}  // namespace

void Solid::add(Shape shape, const Eigen::Vector3f& offset, const Eigen::Vector3f& half, const Colour& colour) {
  const Eigen::Vector3f turned(turn_cos_ * offset.x() - turn_sin_ * offset.y(),
                               turn_sin_ * offset.x() + turn_cos_ * offset.y(), offset.z());
  bodies_.push_back({shape, foot_ + turned, half, turn_cos_, turn_sin_, colour});
}

Solid Solid::stone(const StoneLook& look) {
  Solid s;
  s.foot_ = {static_cast<float>(look.x_m), static_cast<float>(look.y_m), 0.0F};
  s.turn_cos_ = static_cast<float>(std::cos(look.handle_rad));
  s.turn_sin_ = static_cast<float>(std::sin(look.handle_rad));
  const auto r = static_cast<float>(look.radius_m);
  const auto plate = static_cast<float>(look.plate_radius_m);
  const auto top = static_cast<float>(look.plate_height_m);
  s.add(Shape::ellipsoid, {0.0F, 0.0F, 0.0572F}, {r, r, 0.0572F}, look.granite);
  s.add(Shape::cylinder, {0.0F, 0.0F, top - 0.012F}, {plate, plate, 0.012F}, look.plate);
  s.add(Shape::box, {0.0F, -0.055F, top + 0.018F}, {0.014F, 0.014F, 0.018F}, look.plate);
  s.add(Shape::box, {0.0F, 0.005F, top + 0.047F}, {0.014F, 0.075F, 0.012F}, look.plate);
  s.centre_ = s.foot_ + Eigen::Vector3f(0.0F, 0.0F, 0.5F * top);
  s.radius_m_ = r + 0.05F;
  return s;
}

Solid Solid::person(const PersonLook& look) {
  Solid s;
  s.foot_ = {static_cast<float>(look.x_m), static_cast<float>(look.y_m), 0.0F};
  s.turn_cos_ = static_cast<float>(std::cos(look.facing_rad));
  s.turn_sin_ = static_cast<float>(std::sin(look.facing_rad));
  const auto h = static_cast<float>(look.height_m);
  const auto stride = static_cast<float>(look.stride_m);
  for (const float side : {-1.0F, 1.0F}) {
    s.add(Shape::box, {side * 0.10F, -side * 0.5F * stride, 0.235F * h}, {0.07F, 0.08F, 0.235F * h}, look.trousers);
    s.add(Shape::box, {side * 0.24F, 0.02F, 0.64F * h}, {0.05F, 0.06F, 0.17F * h}, look.jacket);
  }
  s.add(Shape::ellipsoid, {0.0F, 0.0F, 0.65F * h}, {0.20F, 0.14F, 0.22F * h}, look.jacket);
  s.add(Shape::ellipsoid, {0.0F, 0.0F, 0.93F * h}, {0.085F, 0.10F, 0.07F * h}, look.skin);
  s.centre_ = s.foot_ + Eigen::Vector3f(0.0F, 0.0F, 0.5F * h);
  s.radius_m_ = 0.56F * h;
  return s;
}

std::optional<Hit> Solid::meet(const Ray& ray) const {
  const Eigen::Vector3f to = centre_ - ray.origin;
  const float along = to.dot(ray.direction);
  const float length2 = ray.direction.squaredNorm();
  if (along <= 0.0F || to.squaredNorm() * length2 - along * along > radius_m_ * radius_m_ * length2)
    return std::nullopt;

  std::optional<Hit> nearest;
  for (const Body& body : bodies_) {
    const Eigen::Vector3f o = ray.origin - body.centre;
    const Eigen::Vector3f& d = ray.direction;
    const Eigen::Vector3f own_o(body.turn_cos * o.x() + body.turn_sin * o.y(),
                                body.turn_cos * o.y() - body.turn_sin * o.x(), o.z());
    const Eigen::Vector3f own_d(body.turn_cos * d.x() + body.turn_sin * d.y(),
                                body.turn_cos * d.y() - body.turn_sin * d.x(), d.z());
    const auto contact = body.shape == Shape::ellipsoid  ? meet_ellipsoid(own_o, own_d, body.half)
                         : body.shape == Shape::cylinder ? meet_cylinder(own_o, own_d, body.half)
                                                         : meet_box(own_o, own_d, body.half);
    if (!contact || (nearest && nearest->distance <= contact->distance)) continue;
    const float light = lit(contact->normal);
    nearest = Hit{contact->distance, {body.colour.red * light, body.colour.green * light, body.colour.blue * light}};
  }
  return nearest;
}

}  // namespace hogline::hw::sim
