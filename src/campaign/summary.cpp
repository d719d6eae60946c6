#include "src/campaign/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>

#include "vision/geometry/sheet.hpp"

namespace hogline::campaign {
namespace {

using nlohmann::ordered_json;

// "no frame for 155 ms" and "no frame for 160 ms" are one reason.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    const bool point =
        text[i] == '.' && i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0;
    if (!digit && !(point && !out.empty() && out.back() == '#')) {
      out += text[i];
    } else if (out.empty() || out.back() != '#') {
      out += '#';
    }
  }
  return out;
}

std::vector<Count> aborts_of(const std::vector<Row>& rows) {
  std::vector<Count> counts;
  for (const Row& row : rows) {
    if (row.abort.empty()) continue;
    const std::string reason = without_numbers(row.abort);
    auto found = std::ranges::find(counts, reason, &Count::what);
    if (found == counts.end()) found = counts.insert(counts.end(), {reason, {}});
    found->throws.push_back(row.number);
  }
  std::ranges::stable_sort(counts, [](const Count& a, const Count& b) { return a.throws.size() > b.throws.size(); });
  return counts;
}

// Their count and the first few numbers, of which each can be thrown again.
std::string listed(const std::vector<int>& throws) {
  constexpr std::size_t at_most = 12;
  if (throws.empty()) return "0";
  const auto end = throws.begin() + static_cast<std::ptrdiff_t>(std::min(throws.size(), at_most));
  return fmt::format("{} ({}{})", throws.size(), fmt::join(throws.begin(), end, ", "),
                     throws.size() > at_most ? ", ..." : "");
}

std::string wanted(const Measure& m) {
  std::string text;
  if (m.wanted_rms) text += fmt::format("RMS {:g}", *m.wanted_rms);
  if (m.wanted_largest) text += fmt::format("{}largest {:g}", text.empty() ? "" : ", ", *m.wanted_largest);
  return text;
}

std::string verdict(const Measure& m, const Statistics& s) {
  if (!m.wanted_rms && !m.wanted_largest) return "";
  if (s.count == 0) return "no throw";
  const bool met = (!m.wanted_rms || s.rms <= *m.wanted_rms) && (!m.wanted_largest || s.largest <= *m.wanted_largest);
  return met ? "met" : "**missed**";
}

// Elite players: 0.76 to 0.95 cm/s of speed and 0.07 to 0.2 deg of aim, which the same ice turns into these.
std::string draws_table(const Summary& s) {
  return fmt::format(
      "\n| resting places of tee draws | throws | mean m | sigma m | elite players' sigma m |\n|---|--:|--:|--:|--:|\n"
      "| along | {} | {:.3f} | {:.3f} | {:.2f} |\n| across | {} | {:.3f} | {:.3f} | {:.2f} |\n",
      s.along_m.count, s.along_m.mean, s.along_m.sigma, elite_along_sigma_m, s.across_m.count, s.across_m.mean,
      s.across_m.sigma, elite_across_sigma_m);
}

ordered_json json_of(const Statistics& x) {
  return {{"count", x.count}, {"mean", x.mean},     {"sigma", x.sigma}, {"rms", x.rms},
          {"q05", x.q05},     {"median", x.median}, {"q95", x.q95},     {"largest", x.largest}};
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> table{
      {"place_error_mm", "release place", "mm", &Row::place_error_mm, 10.0, 35.0},
      {"speed_error_mmps", "speed", "mm/s", &Row::speed_error_mmps, 6.0, {}},
      {"heading_error_deg", "heading", "deg", &Row::heading_error_deg, 0.03, {}},
      {"lateral_error_mm", "lateral", "mm", &Row::lateral_error_mm, 6.0, {}},
      {"spin_error_percent", "spin", "%", &Row::spin_error_percent, {}, 5.0},
      {"yaw_after_alignment_deg", "yaw after alignment", "deg", &Row::yaw_after_alignment_deg, 0.03, {}},
      {"alignment_s", "time to align", "s", &Row::alignment_s, {}, 4.0}};
  return table;
}

Summary summarise(const std::vector<Row>& rows, bool tee_draws) {
  Summary s;
  s.throws = static_cast<int>(rows.size());
  for (const Row& row : rows) {
    s.ok += row.ok ? 1 : 0;
    s.released += row.released ? 1 : 0;
    s.simulated_s += row.simulated_s;
    if (row.hog_line_violation) s.violations.push_back(row.number);
    if (row.stone_burned) s.burned.push_back(row.number);
  }
  s.aborts = aborts_of(rows);
  for (const Measure& m : measures()) {
    std::vector<double> values;
    for (const Row& row : rows) {
      if (row.*m.field) values.push_back(*(row.*m.field));
    }
    s.statistics.push_back(statistics_of(std::move(values)));
  }
  if (!tee_draws) return s;
  std::vector<double> along_m;
  std::vector<double> across_m;
  for (const Row& row : rows) {
    if (!row.rest_x_m || !row.rest_y_m) continue;
    along_m.push_back(*row.rest_y_m - vision::rules::tee_to_tee_m);
    across_m.push_back(*row.rest_x_m);
  }
  s.along_m = statistics_of(std::move(along_m));
  s.across_m = statistics_of(std::move(across_m));
  return s;
}

std::string markdown(const Summary& s) {
  std::string text = fmt::format(
      "{} throws, {} released in their window without fault, {} released. Hog-line violations: {}. Burned stones: "
      "{}.\n\n",
      s.throws, s.ok, s.released, listed(s.violations), listed(s.burned));
  text += "| error of | unit | throws | mean | sigma | RMS | 5 % | median | 95 % | largest | wanted | |\n";
  text += "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|---|---|\n";
  for (std::size_t i = 0; i < measures().size(); ++i) {
    const Measure& m = measures()[i];
    const Statistics& x = s.statistics[i];
    fmt::format_to(std::back_inserter(text),
                   "| {} | {} | {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {} | {} |\n",
                   m.name, m.unit, x.count, x.mean, x.sigma, x.rms, x.q05, x.median, x.q95, x.largest, wanted(m),
                   verdict(m, x));
  }
  if (s.along_m.count > 0) text += draws_table(s);
  text += s.aborts.empty() ? "\nAborts: none.\n" : "\nAborts:\n\n";
  for (const Count& c : s.aborts) text += fmt::format("- {}: {}\n", c.what, listed(c.throws));
  return text;
}

std::string json(const Summary& s) {
  ordered_json root{{"throws", s.throws},         {"ok", s.ok},         {"released", s.released},
                    {"violations", s.violations}, {"burned", s.burned}, {"simulated_s", s.simulated_s}};
  for (std::size_t i = 0; i < measures().size(); ++i) {
    root["measures"][measures()[i].key] = json_of(s.statistics[i]);
  }
  if (s.along_m.count > 0) root["rest"] = {{"along_m", json_of(s.along_m)}, {"across_m", json_of(s.across_m)}};
  root["aborts"] = ordered_json::array();
  for (const Count& c : s.aborts) root["aborts"].push_back({{"reason", c.what}, {"throws", c.throws}});
  return root.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace hogline::campaign
