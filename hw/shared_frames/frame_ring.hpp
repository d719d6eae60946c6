// A camera's newest pictures in POSIX shared memory: the layout, and the mapping of it. doc/programs.md has it as a
// table, for other languages.
//
// One writer, any number of readers. Each slot has a count: odd while it is being written, and raised by two with each
// picture, so that a reader who finds the same even count before and after his copy has a whole picture. A writer that
// dies leaves the memory as it is: his beat stops. One that begins anew makes a new segment under the old name.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hogline::hw {

struct FrameRingShape {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint32_t channels = 0;  ///< 1 or 3 (blue, green, red), a byte each, rows without gaps
  bool operator==(const FrameRingShape&) const = default;
};

inline constexpr std::uint32_t frame_ring_slots = 4;

/// At the segment's beginning. All times are CLOCK_MONOTONIC in nanoseconds; little endian.
struct FrameRingHeader {
  static constexpr std::uint64_t expected_magic = 0x31474E4952464C48;  // "HLFRING1"
  std::uint64_t magic = 0;                                             ///< written last, when all else is there
  std::uint64_t session = 0;
  FrameRingShape shape;
  std::uint32_t slots = 0;
  std::uint64_t slot_bytes = 0;                 ///< from one slot's header to the next one's
  std::atomic<std::int64_t> beat_ns = 0;        ///< when the writer was last alive
  std::atomic<std::int64_t> asked_ns = 0;       ///< when a reader last asked: pictures nobody wants need not be made
  std::atomic<std::uint64_t> newest_count = 0;  ///< pictures written; the newest is in slot (newest_count - 1) % slots
};

/// At each slot's beginning; the picture follows.
struct FrameSlotHeader {
  std::atomic<std::uint64_t> count = 0;  ///< odd while being written
  std::int64_t stamp_ns = 0;             ///< middle of the exposure
  std::uint64_t id = 0;                  ///< the camera's counter
};

static_assert(std::atomic<std::int64_t>::is_always_lock_free);
static_assert(sizeof(FrameRingHeader) == 64 && sizeof(FrameSlotHeader) == 24);

std::size_t frame_ring_bytes(const FrameRingShape& shape);
std::size_t picture_bytes(const FrameRingShape& shape);

/// A segment mapped into this program; unmapped by the destructor.
class FrameRingMapping {
 public:
  /// Nothing when there is no such segment, or it is too small or no frame ring; `problem` says why.
  static std::optional<FrameRingMapping> open(const std::string& name, std::string& problem);
  /// Makes the segment anew: one of that name that was there is unlinked, and stays with whoever has it mapped. Throws
  /// std::system_error.
  static FrameRingMapping create(const std::string& name, const FrameRingShape& shape, std::uint64_t session);

  FrameRingMapping(FrameRingMapping&& other) noexcept;
  FrameRingMapping& operator=(FrameRingMapping&& other) noexcept;
  ~FrameRingMapping();

  FrameRingHeader& header() const { return *static_cast<FrameRingHeader*>(memory_); }
  FrameSlotHeader& slot(std::uint64_t number) const;
  std::byte* picture(std::uint64_t number) const;

 private:
  FrameRingMapping(void* memory, std::size_t bytes) : memory_(memory), bytes_(bytes) {}
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Why a name can not be a segment's; nothing if it can: letters, digits, '.', '-', '_', at most 64.
std::optional<std::string> ring_name_error(const std::string& name);

}  // namespace hogline::hw
