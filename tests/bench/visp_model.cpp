#include "tests/bench/visp_model.hpp"

#include <unistd.h>
#include <visp3/mbt/vpMbGenericTracker.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/bench/undistortion.hpp"
#include "tests/bench/visp_pose.hpp"

namespace hogline::bench {
namespace {

// The tutorial's moving edges (mask 5x5, 180 masks, range 8, mu 0.5, a site every 4 px), with a threshold for a
// contrast of 100 grey levels. The range bears the turn: at 20 deg/s and 60 Hz the picture moves by 4.5 px a frame in
// its middle. Tried as well: ranges 8, 10 and 12, steps 4, 6 and 10, thresholds 4000, 8000 and 20000, thin lines as one
// line or by both their edges. These were the best on the
// turning frames.
vpMe moving_edges() {
  vpMe me;
  me.setMaskSize(5);
  me.setMaskNumber(180);
  me.setRange(8);
  me.setThreshold(20000);
  me.setMu1(0.5);
  me.setMu2(0.5);
  me.setSampleStep(4);
  return me;
}

// vpMeSite looks at whole pixels and reports where it wanted to look: on average half a pixel down and to the right.
// Few users will know; given here, it makes the distance three times better.
constexpr double truncation_px = 0.5;

// ViSP reads its CAD models from files only.
class ModelFile {
 public:
  explicit ModelFile(const std::vector<PaintedLine>& lines) {
    std::string name = "/tmp/hogline-sheet-" + std::string(6, 'X') + ".cao";
    const int file = mkstemps(name.data(), 4);
    if (file < 0) throw std::runtime_error("no temporary file for ViSP's model");
    close(file);
    path_ = name;
    std::ofstream out(path_);
    out << "V1\n" << 2 * lines.size() << "\n";
    for (const PaintedLine& line : lines) {
      out << line.begin.x() << " " << line.begin.y() << " 0\n" << line.end.x() << " " << line.end.y() << " 0\n";
    }
    out << lines.size() << "\n";
    for (std::size_t i = 0; i < lines.size(); ++i) out << 2 * i << " " << 2 * i + 1 << "\n";
    out << "0\n0\n0\n0\n";  // faces of lines, faces of points, cylinders, circles
    if (!out) throw std::runtime_error("can not write ViSP's model to " + path_);
  }
  ModelFile(const ModelFile&) = delete;
  ModelFile& operator=(const ModelFile&) = delete;
  ~ModelFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class VispModel final : public Method {
 public:
  VispModel(const Camera& camera, const std::vector<PaintedLine>& model)
      : mount_(camera.mount), undistortion_(camera.intrinsics), model_(model) {}

  void start(const Frame& frame, const vision::Pose& eMc) override {
    double unused_s = 0.0;
    tracker_ = std::make_unique<vpMbGenericTracker>(1, vpMbGenericTracker::EDGE_TRACKER);
    tracker_->setMovingEdge(moving_edges());
    const cv::Matx33d& K = undistortion_.matrix();
    tracker_->setCameraParameters(
        vpCameraParameters(K(0, 0), K(1, 1), K(0, 2) + truncation_px, K(1, 2) + truncation_px));
    tracker_->setNearClippingDistance(0.3);
    tracker_->setFarClippingDistance(40.0);
    tracker_->setClipping(tracker_->getClipping() | vpPolygon3D::FOV_CLIPPING);
    tracker_->setDisplayFeatures(false);
    load_model();
    tracker_->initFromPose(grey(frame.image, unused_s), to_visp(eMc.inverse()));
  }

  Look look(const Frame& frame) override {
    double undistort_s = 0.0;
    const vpImage<unsigned char>& picture = grey(frame.image, undistort_s);
    if (!tracker_) return refused("not started", undistort_s);
    try {
      tracker_->track(picture);
    } catch (const vpException& e) {
      return refused(e.getStringMessage(), undistort_s);
    }
    vpHomogeneousMatrix cMe;
    tracker_->getPose(cMe);
    const vision::Pose eMc = from_visp(cMe).inverse();
    if (!vision::is_finite(eMc)) return refused("the pose is not finite", undistort_s);
    return {true, {}, vision::planar_body(eMc, mount_), undistort_s};
  }

 private:
  // ViSP tells std::cout about the model, where the tables go.
  void load_model() {
    const ModelFile file(model_);
    std::ostringstream told;
    std::streambuf* const out = std::cout.rdbuf(told.rdbuf());
    try {
      tracker_->loadModel(file.path());
    } catch (...) {
      std::cout.rdbuf(out);
      throw;
    }
    std::cout.rdbuf(out);
  }

  const vpImage<unsigned char>& grey(const cv::Mat& image, double& undistort_s) {
    cv::cvtColor(image, grey_, cv::COLOR_BGR2GRAY);
    const cv::Mat& flat = undistortion_.apply(grey_, undistort_s);
    picture_.init(flat.data, static_cast<unsigned>(flat.rows), static_cast<unsigned>(flat.cols), false);
    return picture_;
  }

  vision::Mount mount_;
  Undistortion undistortion_;
  std::vector<PaintedLine> model_;
  cv::Mat grey_;
  vpImage<unsigned char> picture_;  // a view of the undistorted grey picture
  std::unique_ptr<vpMbGenericTracker> tracker_;
};

}  // namespace

std::unique_ptr<Method> make_visp_model(const Camera& camera, const std::vector<PaintedLine>& model) {
  return std::make_unique<VispModel>(camera, model);
}

}  // namespace hogline::bench
