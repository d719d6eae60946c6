#include "hw/shared_frames/frame_writer.hpp"

#include <sys/mman.h>

#include <cassert>
#include <cstring>

namespace hogline::hw {

FrameWriter::FrameWriter(const std::string& name, const FrameRingShape& shape, std::uint64_t session)
    : name_(name), ring_(FrameRingMapping::create(name, shape, session)) {}

// A writer that came later has a segment of its own under this name: that one stays.
FrameWriter::~FrameWriter() {
  ring_.header().beat_ns = 0;
  std::string problem;
  const auto present = FrameRingMapping::open(name_, problem);
  if (present && present->header().session == ring_.header().session) shm_unlink(("/" + name_).c_str());
}

void FrameWriter::beat(Stamp now) { ring_.header().beat_ns = now.time_since_epoch().count(); }

bool FrameWriter::wanted(Stamp now, Duration span) const {
  const Stamp asked{Duration{ring_.header().asked_ns.load()}};
  return asked != Stamp{} && now - asked < span;
}

void FrameWriter::write(const Frame& frame) {
  const FrameRingHeader& header = ring_.header();
  assert(frame.bgr.cols == static_cast<int>(header.shape.width_px) &&
         frame.bgr.rows == static_cast<int>(header.shape.height_px) &&
         frame.bgr.channels() == static_cast<int>(header.shape.channels) && frame.bgr.depth() == CV_8U);
  const std::uint64_t number = header.newest_count.load(std::memory_order_relaxed);
  FrameSlotHeader& slot = ring_.slot(number);
  slot.count.fetch_add(1, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);  // odd is seen before anything of the picture is
  slot.stamp_ns = frame.stamp.time_since_epoch().count();
  slot.id = frame.id;
  const std::size_t row_bytes = std::size_t{header.shape.width_px} * header.shape.channels;
  for (int row = 0; row < frame.bgr.rows; ++row)
    std::memcpy(ring_.picture(number) + static_cast<std::size_t>(row) * row_bytes, frame.bgr.ptr(row), row_bytes);
  slot.count.fetch_add(1, std::memory_order_release);
  ring_.header().newest_count.store(number + 1, std::memory_order_release);
}

}  // namespace hogline::hw
