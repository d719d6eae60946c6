// Command lines of what looks at devices.
#include <CLI/CLI.hpp>
#include <memory>

#include "src/cli/commands.hpp"
#include "src/doctor_command.hpp"

namespace hogline::cli {

void add_doctor(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<DoctorOptions>();
  DoctorOptions& options = *kept;
  auto* doctor =
      app.add_subcommand("doctor", "every device of a rig: what is found, what is wrong, what to do; moves nothing");
  doctor->add_option("--rig", options.rig, "rig file (YAML)")->required();
  doctor->add_flag("--simulated", options.simulated, "examine the simulated rink in the place of the rig's devices");
  doctor->add_flag("--json", options.json, "one JSON object instead of a table");
  doctor->footer(
      "Examples:\n"
      "  hogline doctor --rig rig.yaml\n"
      "  hogline doctor --rig config/rigs/practice.yaml --simulated --json\n"
      "It listens and reads; nothing is switched on and nothing is ordered. A rig whose cameras are all simulated is\n"
      "examined on the simulated rink. Takes two to thirty seconds.\n"
      "Exit status: 0 all well (notes do not count), 1 something is wrong, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  doctor->callback([kept, &chosen] { chosen = [kept] { return run_doctor(*kept); }; });
}

}  // namespace hogline::cli
