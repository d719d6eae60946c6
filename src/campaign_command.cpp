#include "src/campaign_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "src/campaign/plots.hpp"
#include "src/campaign/resting_plot.hpp"
#include "src/campaign/summary.hpp"
#include "src/campaign/throwing_crew.hpp"
#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/strict_yaml.hpp"
#include "src/drawing_file.hpp"
#include "src/exit_status.hpp"
#include "src/faults/random_faults.hpp"
#include "src/faults/strike_journal.hpp"
#include "src/output/output_file.hpp"
#include "src/output/output_folder.hpp"
#include "src/throw_request.hpp"

namespace hogline {
namespace {

using namespace campaign;

std::string content(const std::string& path, const char* embedded) {
  return path.empty() ? std::string(config::embedded_file(embedded)) : config::read_file(path);
}

Turn turn_of(const std::string& word) {
  if (word == "cw") return Turn::clockwise;
  return word == "ccw" ? Turn::counter_clockwise : Turn::both;
}

// FNV-1a of the program's own file: rows of two builds do not belong in one table.
std::string this_program() {
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  std::vector<char> block(1U << 20U);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    for (std::streamsize i = 0; i < stream.gcount(); ++i) {
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001b3ULL;
    }
  }
  return fmt::format("{:016x}", hash);
}

// A bar where somebody looks on, a line now and then where a file takes it.
class ProgressTeller {
 public:
  ProgressTeller(int done, int total)
      : begun_with_(done), total_(total), bar_(::isatty(STDERR_FILENO) == 1), begin_(Clock::now()), told_(begin_) {}

  void operator()(const Row& row) {
    simulated_s_ += row.simulated_s;
    const int done = row.number + 1;
    const auto now = Clock::now();
    const auto patience = bar_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
    if (now - told_ < patience && done < total_) return;
    told_ = now;
    const double spent_s = std::chrono::duration<double>(now - begin_).count();
    const double left_s = spent_s / (done - begun_with_) * (total_ - done);
    const std::string text = fmt::format("{:5} of {} throws, {:.1f} times real time, {:.0f} s left", done, total_,
                                         simulated_s_ / spent_s, left_s);
    if (bar_) {
      constexpr int width = 30;
      const int full = width * done / total_;
      fmt::print(stderr, "\r[{}{}] {}{}", std::string(static_cast<std::size_t>(full), '='),
                 std::string(static_cast<std::size_t>(width - full), ' '), text, done == total_ ? "\n" : "  ");
    } else {
      fmt::print(stderr, "{}\n", text);
    }
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  int begun_with_;
  int total_;
  bool bar_;
  Clock::time_point begin_;
  Clock::time_point told_;
  double simulated_s_ = 0.0;
};

}  // namespace

std::string number_or_range(const std::string& text) {
  if (parse_span(text)) return {};
  return fmt::format("'{}' is no number and no range LOW..HIGH", text);
}

namespace {

int run_faults_at_random(const CampaignOptions& options) {
  const OutputFolder folder("--out", options.out);
  auto chosen = faults::faults_of_any_moment();
  if (options.faults != "all") {
    std::erase_if(chosen, [&](const auto* fault) { return !faults::mentions(*fault, options.faults); });
  }
  if (chosen.empty()) {
    throw config::ConfigError(
        "command line", 0, "--faults", options.faults,
        "must be all, or words of a fault's group, name or way of injection; doc/faults.md lists them");
  }
  const int count = static_cast<int>(chosen.size()) * options.per_fault;
  faults::StrikeJournal journal(options.out + "/strikes.jsonl", chosen, options.seed, this_program());
  int done = static_cast<int>(journal.known().size());
  if (done > 0) fmt::print(stderr, "{} throws are in {} already\n", done, options.out);
  const auto note = [&](const faults::StrikePlace& place, const faults::RandomStrike& strike) {
    journal.append(place, strike);
    if (++done % 50 == 0 || done == count) fmt::print(stderr, "{} of {} throws with a fault\n", done, count);
  };
  const auto known = journal.known();
  const auto strikes = faults::strike_at_random(chosen, options.per_fault, options.seed, options.jobs, note, known);
  write_text(options.out + "/faults.csv", faults::strikes_csv(strikes));
  const std::string page = faults::strikes_page(strikes);
  write_text(options.out + "/faults.md", page);
  fmt::print("{}", page);
  return faults::safe(strikes) ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace

PlanText plan_of(const CampaignOptions& o) {
  return {.rig = content(o.rig, "rigs/practice.yaml"),
          .scenario = content(o.scenario, "scenarios/practice.yaml"),
          .seed = o.seed,
          .eyes = eyes_of(o.seer),
          .speed_mps = parse_span(o.speed_mps).value(),
          .heading_deg = parse_span(o.heading_deg).value(),
          .spin_radps = parse_span(o.spin_radps).value(),
          .turn = turn_of(o.curl),
          .tee_draws = o.tee_draws,
          .without = parse_without(o.without).value()};
}

int run_campaign(const CampaignOptions& options) {
  if (!options.faults.empty()) return run_faults_at_random(options);
  if (options.throws < 1) {
    throw config::ConfigError("command line", 0, "--throws", "", "is missing: how many there shall be");
  }
  const Plan plan(plan_of(options));
  Folder folder(options.out, plan, this_program());
  const int there = static_cast<int>(folder.rows().size());
  if (there > 0) fmt::print(stderr, "{} throws are in {} already\n", there, options.out);
  throw_missing(plan, options.throws, options.jobs, folder, ProgressTeller(there, options.throws));

  const Summary summary = summarise(folder.rows(), options.tee_draws);
  write_text(options.out + "/summary.md", markdown(summary));
  write_text(options.out + "/summary.json", json(summary));
  DrawingFolder drawings("--out", options.out);
  drawings.save("distributions", distributions(folder.rows()));
  if (options.tee_draws) drawings.save("resting-places", resting_places(folder.rows()));
  fmt::print("{}", markdown(summary));
  return summary.ok == summary.throws ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
