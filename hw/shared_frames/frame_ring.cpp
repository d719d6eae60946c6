#include "hw/shared_frames/frame_ring.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

namespace hogline::hw {
namespace {

constexpr std::size_t line = 64;  // of the processor's cache
constexpr std::uint32_t most_pixels_a_side = 16384;

std::size_t slot_bytes(const FrameRingShape& shape) {
  return (sizeof(FrameSlotHeader) + picture_bytes(shape) + line - 1) / line * line;
}

std::string path_of(const std::string& name) { return "/" + name; }

[[noreturn]] void fail(const std::string& doing) { throw std::system_error(errno, std::generic_category(), doing); }

bool sensible(const FrameRingShape& shape) {
  return shape.width_px >= 1 && shape.width_px <= most_pixels_a_side && shape.height_px >= 1 &&
         shape.height_px <= most_pixels_a_side && (shape.channels == 1 || shape.channels == 3);
}

// What another program wrote is believed only as far as the memory reaches.
std::string problem_of(const FrameRingHeader& header, std::size_t bytes) {
  if (header.magic != FrameRingHeader::expected_magic) return "is no ring of frames, or not yet";
  if (!sensible(header.shape) || header.slots != frame_ring_slots || header.slot_bytes != slot_bytes(header.shape) ||
      bytes < frame_ring_bytes(header.shape)) {
    return "holds another layout than this program knows";
  }
  return {};
}

}  // namespace

std::size_t picture_bytes(const FrameRingShape& shape) {
  return std::size_t{shape.width_px} * shape.height_px * shape.channels;
}

std::size_t frame_ring_bytes(const FrameRingShape& shape) {
  return sizeof(FrameRingHeader) + frame_ring_slots * slot_bytes(shape);
}

std::optional<std::string> ring_name_error(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_'; };
  if (!name.empty() && name.size() <= 64 && std::ranges::all_of(name, allowed)) return std::nullopt;
  return "must be 1 to 64 letters, digits, '.', '-' or '_'";
}

std::optional<FrameRingMapping> FrameRingMapping::open(const std::string& name, std::string& problem) {
  const int file = shm_open(path_of(name).c_str(), O_RDWR | O_CLOEXEC, 0);
  if (file < 0) {
    problem = std::strerror(errno);
    return std::nullopt;
  }
  struct stat status {};
  const bool whole = fstat(file, &status) == 0 && status.st_size >= static_cast<off_t>(sizeof(FrameRingHeader));
  const auto bytes = whole ? static_cast<std::size_t>(status.st_size) : 0;
  void* memory = whole ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  ::close(file);
  if (memory == MAP_FAILED) {
    problem = whole ? std::strerror(errno) : "is no ring of frames, or not yet";
    return std::nullopt;
  }
  FrameRingMapping mapping(memory, bytes);
  problem = problem_of(mapping.header(), bytes);
  if (!problem.empty()) return std::nullopt;
  return mapping;
}

FrameRingMapping FrameRingMapping::create(const std::string& name, const FrameRingShape& shape, std::uint64_t session) {
  const std::string path = path_of(name);
  shm_unlink(path.c_str());
  const int file = shm_open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) fail("shared memory " + name);
  const std::size_t bytes = frame_ring_bytes(shape);
  const int full = posix_fallocate(file, 0, static_cast<off_t>(bytes));  // a full disk is told here, not by SIGBUS
  void* memory = full == 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  if (full != 0) errno = full;
  ::close(file);
  if (memory == MAP_FAILED) fail("shared memory " + name);

  FrameRingMapping mapping(memory, bytes);
  auto* header = new (memory) FrameRingHeader;
  header->session = session;
  header->shape = shape;
  header->slots = frame_ring_slots;
  header->slot_bytes = slot_bytes(shape);
  for (std::uint64_t i = 0; i < frame_ring_slots; ++i) new (&mapping.slot(i)) FrameSlotHeader;
  std::atomic_thread_fence(std::memory_order_release);
  header->magic = FrameRingHeader::expected_magic;
  return mapping;
}

FrameRingMapping::FrameRingMapping(FrameRingMapping&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)), bytes_(other.bytes_) {}

FrameRingMapping& FrameRingMapping::operator=(FrameRingMapping&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

FrameRingMapping::~FrameRingMapping() {
  if (memory_ != nullptr) munmap(memory_, bytes_);
}

FrameSlotHeader& FrameRingMapping::slot(std::uint64_t number) const {
  auto* bytes = static_cast<std::byte*>(memory_) + sizeof(FrameRingHeader);
  return *reinterpret_cast<FrameSlotHeader*>(bytes + (number % frame_ring_slots) * header().slot_bytes);
}

std::byte* FrameRingMapping::picture(std::uint64_t number) const {
  return reinterpret_cast<std::byte*>(&slot(number)) + sizeof(FrameSlotHeader);
}

}  // namespace hogline::hw
