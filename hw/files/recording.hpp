// A folder of recorded pictures as frames: which file, which number, what time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw::files {

struct RecordedFrame {
  std::string path;
  std::uint64_t id = 0;
  Duration time{};  ///< middle of the exposure, after the recording's beginning
};

/// Either frames in the order of their times, or one line that names the file and what is wrong with it.
struct Recording {
  std::vector<RecordedFrame> frames;
  std::string problem;
};

/// Every JPEG and PNG file of a folder in the order of the numbers in their names (2 before 10), at a steady rate,
/// numbered from 0. Precondition: rate_hz > 0.
Recording read_folder(const std::string& folder, double rate_hz);

/// The pictures that a stamps file lists: a line each of `name,id,time_s`, after a first line of just these words.
/// Names are relative to the stamps file's folder. Numbers and times must grow; a gap in the numbers is a lost frame.
Recording read_stamps_file(const std::string& path);

}  // namespace hogline::hw::files
