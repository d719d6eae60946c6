#include "src/doctor/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace hogline::doctor {
namespace {

using nlohmann::ordered_json;

std::size_t widest(const std::vector<Finding>& findings, std::string Finding::*column) {
  std::size_t width = 0;
  for (const Finding& finding : findings) width = std::max(width, (finding.*column).size());
  return width;
}

ordered_json remarks_json(const std::vector<Remark>& remarks) {
  ordered_json list = ordered_json::array();
  for (const Remark& r : remarks) {
    list.push_back({{"weight", to_string(r.weight)}, {"what", r.what}, {"advice", r.advice}});
  }
  return list;
}

ordered_json values_json(const Finding& finding) {
  ordered_json values = ordered_json::object();
  for (const auto& [name, value] : finding.values) {
    std::visit([&values, &key = name](const auto& v) { values[key] = v; }, value);
  }
  return values;
}

}  // namespace

std::string table(const std::vector<Finding>& findings) {
  std::string text;
  const auto out = std::back_inserter(text);
  const std::size_t device = widest(findings, &Finding::device);
  const std::size_t line = widest(findings, &Finding::line);
  for (const Finding& f : findings) {
    fmt::format_to(out, "{:<{}}  {:<5}  {:<{}}  {}\n", f.device, device, to_string(f.verdict()), f.line, line, f.found);
  }
  for (const Verdict weight : {Verdict::wrong, Verdict::note}) {
    for (const Finding& f : findings) {
      for (const Remark& r : f.remarks) {
        if (r.weight != weight) continue;
        fmt::format_to(out, "\n{}: {}: {}\n  -> {}\n", to_string(weight), f.device, r.what, r.advice);
      }
    }
  }
  const auto wrong = std::ranges::count_if(findings, [](const Finding& f) { return f.verdict() == Verdict::wrong; });
  if (wrong == 0) {
    fmt::format_to(out, "\nall well\n");
  } else {
    fmt::format_to(out, "\n{} of {} devices: something is wrong\n", wrong, findings.size());
  }
  return text;
}

std::string json_line(const std::vector<Finding>& findings, const std::string& rig, bool simulated) {
  ordered_json report{{"ok", all_well(findings)}, {"rig", rig}, {"simulated", simulated}};
  report["devices"] = ordered_json::array();
  for (const Finding& f : findings) {
    report["devices"].push_back({{"device", f.device},
                                 {"line", f.line},
                                 {"verdict", to_string(f.verdict())},
                                 {"found", f.found},
                                 {"values", values_json(f)},
                                 {"remarks", remarks_json(f.remarks)}});
  }
  return report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace hogline::doctor
