// The camera's side of a ring of frames in shared memory.
#pragma once

#include <string>

#include "hw/camera.hpp"
#include "hw/shared_frames/frame_ring.hpp"

namespace hogline::hw {

class FrameWriter {
 public:
  /// Makes the segment. `session`: one per start of the writer, not 0. Throws std::system_error.
  FrameWriter(const std::string& name, const FrameRingShape& shape, std::uint64_t session);
  /// The segment goes; readers who have it mapped see the beat stop.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// At least every 50 ms, also while there are no frames.
  void beat(Stamp now);
  /// Somebody asked for pictures within `span`.
  bool wanted(Stamp now, Duration span) const;
  /// Precondition: the picture has the ring's size and channels.
  void write(const Frame& frame);

 private:
  std::string name_;
  FrameRingMapping ring_;
};

}  // namespace hogline::hw
