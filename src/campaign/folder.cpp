#include "src/campaign/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "src/config/config_error.hpp"
#include "src/config/strict_yaml.hpp"
#include "src/output/output_file.hpp"

namespace hogline::campaign {
namespace {

using config::ConfigError;
using nlohmann::ordered_json;

constexpr const char* options_name = "options.json";

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path, what, std::strerror(errno)));
}

ordered_json options_of(const PlanText& text, const std::string& program) {
  return {{"seed", text.seed},
          {"seer", text.eyes == Eyes::oracle ? "oracle" : "rendered"},
          {"speed", to_string(text.speed_mps)},
          {"heading-deg", to_string(text.heading_deg)},
          {"spin", to_string(text.spin_radps)},
          {"curl", to_string(text.turn)},
          {"tee-draws", text.tee_draws},
          {"without", to_string(text.without)},
          {"program", program}};
}

ordered_json read_options(const std::string& folder) {
  const std::string path = folder + "/" + options_name;
  ordered_json options = ordered_json::parse(config::read_file(path), nullptr, false);
  if (!options.is_object()) throw ConfigError(path, 0, "", "", "is no campaign's options");
  return options;
}

void refuse_other(const std::string& folder, const std::string& what) {
  throw ConfigError("command line", 0, "--out", folder,
                    "holds a campaign with " + what + "; go on with the same, or name another folder");
}

void compare(const std::string& folder, const ordered_json& there, const ordered_json& here) {
  for (const auto& [key, value] : here.items()) {
    const ordered_json other = there.value(key, ordered_json());
    if (other == value) continue;
    if (key == "program") refuse_other(folder, "rows of another build of this program");
    refuse_other(folder, fmt::format("another --{}: {} there, {} here", key, other.dump(), value.dump()));
  }
}

Span span_of(const ordered_json& options, const char* key) {
  const auto span = parse_span(options.at(key).get<std::string>());
  if (!span) throw std::runtime_error(fmt::format("{} is no number or range", key));
  return *span;
}

std::string finished(std::string text) {
  const auto end = text.rfind('\n');
  text.resize(end == std::string::npos ? 0 : end + 1);
  return text;
}

Turn turn_of(const std::string& word) {
  if (word == "cw") return Turn::clockwise;
  return word == "ccw" ? Turn::counter_clockwise : Turn::both;
}

}  // namespace

PlanText read_plan(const std::string& path) {
  const ordered_json options = read_options(path);
  try {
    return {.rig = config::read_file(path + "/rig.yaml"),
            .scenario = config::read_file(path + "/scenario.yaml"),
            .seed = options.at("seed").get<std::uint64_t>(),
            .eyes = options.at("seer") == "oracle" ? Eyes::oracle : Eyes::vision,
            .speed_mps = span_of(options, "speed"),
            .heading_deg = span_of(options, "heading-deg"),
            .spin_radps = span_of(options, "spin"),
            .turn = turn_of(options.at("curl").get<std::string>()),
            .tee_draws = options.at("tee-draws").get<bool>(),
            .without = parse_without(options.at("without").get<std::string>()).value()};
  } catch (const ConfigError&) {
    throw;
  } catch (const std::exception& e) {
    throw ConfigError(path + "/" + options_name, 0, "", "", fmt::format("is no campaign's options: {}", e.what()));
  }
}

std::vector<Row> read_rows(const std::string& path) {
  const std::string table = path + "/throws.csv";
  const std::string text = finished(config::read_file(table));
  std::vector<Row> rows;
  std::size_t begin = 0;
  for (int line = 0; begin < text.size(); ++line) {
    const std::size_t end = text.find('\n', begin);
    const std::string_view words = std::string_view(text).substr(begin, end - begin);
    const auto row = line == 0 ? std::nullopt : parse_row(words);
    const bool fine = line == 0 ? words == header() : row && row->number == line - 1;
    if (!fine) throw ConfigError(table, line + 1, "", "", "is no row of a campaign; was the file edited?");
    if (row) rows.push_back(*row);
    begin = end + 1;
  }
  return rows;
}

Folder::Folder(const std::string& path, const Plan& plan, const std::string& program)
    : path_(path), lock_("--out", path) {
  open();
  take_up(plan, program);
  cut_unfinished();
  rows_ = campaign::read_rows(path);
}

Folder::Table::~Table() {
  if (descriptor >= 0) ::close(descriptor);
}

void Folder::open() {
  const std::string table = path_ + "/throws.csv";
  table_.descriptor = ::open(table.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (table_.descriptor < 0) fail(table, "can not be opened");
}

void Folder::take_up(const Plan& plan, const std::string& program) {
  const ordered_json here = options_of(plan.text(), program);
  if (std::filesystem::exists(path_ + "/" + options_name)) {
    compare(path_, read_options(path_), here);
    if (config::read_file(path_ + "/rig.yaml") != plan.text().rig) refuse_other(path_, "another rig");
    if (config::read_file(path_ + "/scenario.yaml") != plan.text().scenario) refuse_other(path_, "another scenario");
    return;
  }
  if (std::filesystem::file_size(path_ + "/throws.csv") > 0) refuse_other(path_, "unknown options");
  replace_text(path_ + "/rig.yaml", plan.text().rig);
  replace_text(path_ + "/scenario.yaml", plan.text().scenario);
  replace_text(path_ + "/" + options_name, here.dump(2) + "\n");
}

// What follows the last end of a line was not finished.
void Folder::cut_unfinished() {
  const std::string table = path_ + "/throws.csv";
  const std::string text = finished(config::read_file(table));
  if (::ftruncate(table_.descriptor, static_cast<off_t>(text.size())) != 0) fail(table, "can not be cut");
  if (text.empty()) write(header() + "\n");
}

void Folder::append(const Row& row) {
  assert(row.number == static_cast<int>(rows_.size()));
  write(line_of(row) + "\n");
  rows_.push_back(row);
}

void Folder::write(const std::string& text) {
  if (::write(table_.descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size())) return;
  fail(path_ + "/throws.csv", "can not be written");
}

}  // namespace hogline::campaign
