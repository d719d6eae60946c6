#include "src/doctor_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/doctor/examination.hpp"
#include "src/doctor/report.hpp"
#include "src/doctor/simulated_site.hpp"
#include "src/doctor/steel_site.hpp"
#include "src/exit_status.hpp"

namespace hogline {
namespace {

// A rig whose cameras are all on the simulated rink is a rig of the simulated rink.
bool is_simulated(const config::Rig& rig) {
  return !rig.sources.empty() && std::ranges::all_of(rig.sources, [](const auto& entry) {
    return std::holds_alternative<config::SimulatedSource>(entry.second.device);
  });
}

std::vector<doctor::Finding> examine_simulated(const std::string& file, const config::DeviceRig& devices) {
  if (!config::is_thrower(devices)) {
    throw config::ConfigError(file, 0, "", "",
                              "is no thrower's rig, and the simulated rink's devices are a thrower's; `hogline skip` "
                              "runs the skip on its own");
  }
  constexpr std::uint64_t seed = 1;
  const config::ThrowerRig rig = config::load_thrower_rig(file);
  SimulatedRobot robot(
      rig, config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", seed));
  doctor::SimulatedSite site(robot);
  return doctor::examine(config::devices_of(rig), site);
}

std::vector<doctor::Finding> examine_steel(const config::DeviceRig& rig) {
  if (rig.rig.can_udp) {
    throw config::ConfigError(rig.rig.file, 0, "can.udp_multicast", rig.rig.can_udp->group,
                              "is for simulations; the doctor examines the kernel's CAN interface (can.interface)");
  }
  if ((rig.drive || rig.head) && rig.rig.can_interface.empty()) {
    throw config::ConfigError(rig.rig.file, 0, "can.interface", "",
                              "missing; the doctor needs the CAN interface's name, e.g. can0 (or --simulated)");
  }
  doctor::SteelSite site(rig);
  return doctor::examine(rig, site);
}

}  // namespace

int run_doctor(const DoctorOptions& options) {
  const config::DeviceRig rig = config::load_device_rig(options.rig);
  const bool simulated = options.simulated || (is_simulated(rig.rig) && config::is_thrower(rig));
  const auto findings = simulated ? examine_simulated(options.rig, rig) : examine_steel(rig);
  if (options.json) {
    fmt::print("{}\n", doctor::json_line(findings, options.rig, simulated));
  } else {
    fmt::print("{}{}\n\n{}", options.rig, simulated ? ", on the simulated rink" : "", doctor::table(findings));
  }
  return doctor::all_well(findings) ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
