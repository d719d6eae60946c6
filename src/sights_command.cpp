#include "src/sights_command.hpp"

#include <fmt/format.h>

#include "src/campaign/sights.hpp"
#include "src/exit_status.hpp"
#include "src/output/output_file.hpp"
#include "src/output/output_folder.hpp"
#include "src/throw_request.hpp"

namespace hogline {
int run_sights(const CampaignOptions& options) {
  const campaign::Plan plan(plan_of(options));
  const OutputFolder folder("--out", options.out);
  fmt::print(stderr, "watching {} rendered throws\n", options.throws);
  int done = 0;
  const auto sightings = campaign::watch_throws(
      plan, options.throws, options.jobs, [&] { fmt::print(stderr, "{} of {} throws\n", ++done, options.throws); });
  write_text(options.out + "/sights.csv", campaign::sightings_csv(sightings));

  const OracleQuality quality = campaign::fit_oracle(sightings);
  if (quality.near.knots.empty() || quality.low.knots.empty()) {
    fmt::print(stderr, "hogline: too little was seen to measure: throw more\n");
    return ExitStatus::not_achieved;
  }
  const std::string scenario = options.scenario.empty() ? "the practice scenario" : options.scenario;
  const std::string text = oracle_text(
      quality,
      fmt::format("How vision sees, measured over {} looks of {} rendered throws:\n"
                  "  hogline sights --throws {} --seed {} --scenario {} --speed {}\n"
                  "Standard deviations; offset is a mean. Claimed is what the percepts say of themselves.",
                  sightings.size(), options.throws, options.throws, options.seed, scenario, options.speed_mps));
  write_text(options.out + "/oracle.yaml", text);
  fmt::print("{}", text);
  return ExitStatus::success;
}

}  // namespace hogline
