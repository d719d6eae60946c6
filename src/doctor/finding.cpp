#include "src/doctor/finding.hpp"

#include <algorithm>

namespace hogline::doctor {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::note:
      return "note";
    case Verdict::wrong:
      return "wrong";
  }
  return "unknown";
}

Verdict Finding::verdict() const {
  Verdict worst = Verdict::ok;
  for (const Remark& remark : remarks) worst = std::max(worst, remark.weight);
  return worst;
}

bool all_well(const std::vector<Finding>& findings) {
  return std::ranges::none_of(findings, [](const Finding& f) { return f.verdict() == Verdict::wrong; });
}

}  // namespace hogline::doctor
