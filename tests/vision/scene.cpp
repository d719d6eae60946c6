#include "tests/vision/scene.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace hogline::vision::testing {
namespace {

using nlohmann::json;

Pose pose_of(const json& rows) {
  Pose pose = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c)
      pose.matrix()(r, c) = rows.at(static_cast<std::size_t>(r)).at(static_cast<std::size_t>(c));
  }
  return pose;
}

// The angles of Rz(yaw) Ry(pitch) Rx(roll) from the optical axes' directions in b.
Mount mount_of(const Pose& bMc) {
  const Eigen::Matrix3d R = bMc.linear();
  return {bMc.translation().x(),
          bMc.translation().y(),
          bMc.translation().z(),
          std::atan2(-R(2, 0), -R(2, 1)),
          std::atan2(-R(2, 2), std::hypot(R(0, 2), R(1, 2))),
          std::atan2(R(1, 2), R(0, 2))};
}

Intrinsics intrinsics_of(const json& camera) {
  Intrinsics k{camera.at("width"), camera.at("height"), LensModel::brown_conrady, camera.at("fx"),
               camera.at("fy"),    camera.at("cx"),     camera.at("cy"),          {}};
  if (camera.at("model") == "kannala_brandt") k.model = LensModel::kannala_brandt;
  for (std::size_t i = 0; i < camera.at("dist").size(); ++i) k.distortion.at(i) = camera.at("dist").at(i);
  return k;
}

SidelineKind kind_of(const std::string& name) {
  if (name == "line") return SidelineKind::line;
  if (name == "bumper") return SidelineKind::bumper;
  if (name == "none") return SidelineKind::none;
  return SidelineKind::unknown;
}

}  // namespace

Scene load_scene(const std::string& name) { return load_scene_file(std::string(HOGLINE_TEST_DATA) + "/" + name); }

Scene load_scene_file(const std::string& base) {
  std::ifstream file(base + ".json");
  if (!file) throw std::runtime_error("no scene " + base);
  const json t = json::parse(file);
  Scene scene;
  scene.image = cv::imread(base + ".jpg", cv::IMREAD_COLOR);
  if (scene.image.empty()) throw std::runtime_error("no picture of scene " + base);
  scene.setup.intrinsics = intrinsics_of(t.at("camera"));
  scene.setup.mount = mount_of(pose_of(t.at("T_body_camera")));
  scene.setup.gamma = t.at("gamma");
  scene.setup.ice = {t.at("ice").at("paint_depth"), t.at("ice").at("refractive_index")};
  scene.sideline = t.at("sheet").at("sideline");
  scene.setup.sheet.sideline = kind_of(scene.sideline);
  scene.sheet_width_m = t.at("sheet").at("width");
  scene.eMc = pose_of(t.at("T_end_camera"));
  const json& robot = t.at("robot");
  scene.body = {robot.at("x"), robot.at("y"), robot.at("yaw_deg").get<double>() * std::numbers::pi / 180.0};
  return scene;
}

}  // namespace hogline::vision::testing
