#include "hw/files/jpeg_damage.hpp"

// libjpeg's header needs these two.
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include <array>

namespace hogline::hw::files {
namespace {

/// libjpeg's own part comes first: it hands that back.
struct Complaints {
  jpeg_error_mgr manager;
  std::jmp_buf given_up;
  std::array<char, JMSG_LENGTH_MAX> first;  ///< empty: none
};

Complaints& of(j_common_ptr decoder) { return *reinterpret_cast<Complaints*>(decoder->err); }

void note(j_common_ptr decoder) {
  if (of(decoder).first[0] == '\0') decoder->err->format_message(decoder, of(decoder).first.data());
}

void note_warning(j_common_ptr decoder, int level) {
  constexpr int warning = -1;
  if (level == warning) note(decoder);
}

[[noreturn]] void give_up(j_common_ptr decoder) {
  note(decoder);
  std::longjmp(of(decoder).given_up, 1);
}

void tell_nobody(j_common_ptr /*decoder*/) {}

// A jump out of libjpeg passes this function alone, which owns nothing that would have to be destroyed.
void read_codes(jpeg_decompress_struct& decoder, Complaints& complaints, std::span<const std::uint8_t> bytes) {
  if (setjmp(complaints.given_up) != 0) return;
  jpeg_mem_src(&decoder, bytes.data(), bytes.size());
  jpeg_read_header(&decoder, TRUE);
  jpeg_read_coefficients(&decoder);
  jpeg_finish_decompress(&decoder);
}

}  // namespace

std::optional<std::string> jpeg_damage(std::span<const std::uint8_t> bytes) {
  Complaints complaints{};
  jpeg_decompress_struct decoder{};
  decoder.err = jpeg_std_error(&complaints.manager);
  complaints.manager.error_exit = give_up;
  complaints.manager.emit_message = note_warning;
  complaints.manager.output_message = tell_nobody;
  jpeg_create_decompress(&decoder);
  read_codes(decoder, complaints, bytes);
  jpeg_destroy_decompress(&decoder);
  if (complaints.first[0] == '\0') return std::nullopt;
  return std::string(complaints.first.data());
}

}  // namespace hogline::hw::files
