#include "src/doctor/simulated_site.hpp"

namespace hogline::doctor {

hw::Camera* SimulatedSite::camera(const std::string& name) {
  if (name == "near") return &robot_.near_camera();
  if (name == "low") return &robot_.low_camera();
  return nullptr;  // nobody renders a far camera
}

}  // namespace hogline::doctor
