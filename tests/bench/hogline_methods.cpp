#include "tests/bench/hogline_methods.hpp"

#include "vision/low_sequence.hpp"
#include "vision/low_view.hpp"
#include "vision/near_sequence.hpp"
#include "vision/near_view.hpp"

namespace hogline::bench {
namespace {

Look look_of(const SheetPosePercept& percept) {
  Look look;
  look.ok = percept.ok;
  look.reason = percept.reason;
  look.body = percept.body;
  return look;
}

class NearAcquire final : public Method {
 public:
  explicit NearAcquire(const vision::CameraSetup& setup) : view_(setup) {}
  void start(const Frame&, const vision::Pose&) override {}
  Look look(const Frame& frame) override { return look_of(view_.acquire(frame.image, frame.stamp)); }

 private:
  vision::NearView view_;
};

class NearTrack final : public Method {
 public:
  explicit NearTrack(const vision::CameraSetup& setup) : sequence_(setup) {}
  void start(const Frame&, const vision::Pose&) override {}
  Look look(const Frame& frame) override { return look_of(sequence_.step(frame.image, frame.stamp)); }

 private:
  vision::NearSequence sequence_;
};

class LowAcquire final : public Method {
 public:
  explicit LowAcquire(const vision::CameraSetup& setup) : view_(setup) {}
  void start(const Frame&, const vision::Pose&) override {}
  Look look(const Frame& frame) override { return look_of(view_.acquire(frame.image, frame.stamp)); }

 private:
  vision::LowView view_;
};

class LowTrack final : public Method {
 public:
  explicit LowTrack(const vision::CameraSetup& setup) : sequence_(setup) {}
  void start(const Frame&, const vision::Pose&) override {}
  Look look(const Frame& frame) override { return look_of(sequence_.step(frame.image, frame.stamp)); }

 private:
  vision::LowSequence sequence_;
};

}  // namespace

std::unique_ptr<Method> make_near_acquire(const vision::CameraSetup& setup) {
  return std::make_unique<NearAcquire>(setup);
}

std::unique_ptr<Method> make_near_track(const vision::CameraSetup& setup) { return std::make_unique<NearTrack>(setup); }

std::unique_ptr<Method> make_low_acquire(const vision::CameraSetup& setup) {
  return std::make_unique<LowAcquire>(setup);
}

std::unique_ptr<Method> make_low_track(const vision::CameraSetup& setup) { return std::make_unique<LowTrack>(setup); }

}  // namespace hogline::bench
