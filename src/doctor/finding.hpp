// What the doctor found at one device: facts, and what is wrong with what to do about it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hogline::doctor {

enum class Verdict {
  ok,
  note,   ///< worth knowing before a throw, and may be meant so
  wrong,  ///< the robot can not throw like this
};

const char* to_string(Verdict verdict);

struct Remark {
  Verdict weight = Verdict::wrong;  ///< note or wrong
  std::string what;
  std::string advice;  ///< what to do next
};

using Value = std::variant<double, std::int64_t, std::string>;

struct Finding {
  std::string device;                                 ///< "left wheel"
  std::string line;                                   ///< "CAN can0, node 1"
  std::string found;                                  ///< one line for people
  std::vector<std::pair<std::string, Value>> values;  ///< for machines; names end in their units
  std::vector<Remark> remarks;

  void note(std::string what, std::string advice) {
    remarks.push_back({Verdict::note, std::move(what), std::move(advice)});
  }
  void wrong(std::string what, std::string advice) {
    remarks.push_back({Verdict::wrong, std::move(what), std::move(advice)});
  }
  /// The worst of the remarks.
  Verdict verdict() const;
};

/// True if nothing is wrong; notes do not count.
bool all_well(const std::vector<Finding>& findings);

}  // namespace hogline::doctor
