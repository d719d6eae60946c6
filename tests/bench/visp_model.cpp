#include "tests/bench/visp_model.hpp"

#include <unistd.h>
#include <visp3/mbt/vpMbGenericTracker.h>

#include <cstdio>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tests/bench/undistortion.hpp"
#include "tests/bench/visp_pose.hpp"

namespace hogline::bench {
namespace {

// The tutorial's moving edges (mask 5x5, 180 masks, mu 0.5) but for two settings. The range must bear the turn: at
// 20 deg/s and 60 Hz the picture moves by 4.5 px a frame in its middle and 9 at its sides. The threshold: thin lines 8
// m off are one pixel of half the contrast.
vpMe moving_edges() {
  vpMe me;
  me.setMaskSize(5);
  me.setMaskNumber(180);
  me.setRange(12);
  me.setThreshold(8000);
  me.setMu1(0.5);
  me.setMu2(0.5);
  me.setSampleStep(6);
  return me;
}

// ViSP reads its CAD models from files only.
class ModelFile {
 public:
  explicit ModelFile(const std::vector<PaintedLine>& lines) {
    char name[] = "/tmp/hogline-sheet-XXXXXX.cao";
    const int file = mkstemps(name, 4);
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
    tracker_->setCameraParameters(vpCameraParameters(K(0, 0), K(1, 1), K(0, 2), K(1, 2)));
    tracker_->setNearClippingDistance(0.3);
    tracker_->setFarClippingDistance(40.0);
    tracker_->setClipping(tracker_->getClipping() | vpPolygon3D::FOV_CLIPPING);
    tracker_->setDisplayFeatures(false);
    const ModelFile file(model_);
    tracker_->loadModel(file.path());
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
