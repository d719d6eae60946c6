#include <gsl/gsl_errno.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "src/cli/commands.hpp"
#include "src/cli/parsing.hpp"
#include "src/config/config_error.hpp"
#include "src/exit_status.hpp"

namespace {

using hogline::ExitStatus;

// GSL's default handler aborts the program on a singular matrix; results are checked for finiteness instead.
void prepare_libraries() {
  gsl_set_error_handler_off();
  cv::setNumThreads(1);
}

int run(int argc, char** argv) {
  CLI::App app{"hogline: visual servoing for a team of two curling robots", "hogline"};
  app.set_version_flag("--version", HOGLINE_VERSION);
  app.require_subcommand(1);
  hogline::cli::Chosen chosen;
  for (const auto add :
       {hogline::cli::add_pose,   hogline::cli::add_stones,   hogline::cli::add_board,  hogline::cli::add_throw,
        hogline::cli::add_demo,   hogline::cli::add_doctor,   hogline::cli::add_turn,   hogline::cli::add_game,
        hogline::cli::add_faults, hogline::cli::add_campaign, hogline::cli::add_sights, hogline::cli::add_skip,
        hogline::cli::add_track,  hogline::cli::add_skips,    hogline::cli::add_keys,   hogline::cli::add_link,
        hogline::cli::add_rink,   hogline::cli::add_thrower,  hogline::cli::add_hold,   hogline::cli::add_order})
    add(app, chosen);
  if (const auto done = hogline::cli::parse(app, argc, argv)) return *done;
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  prepare_libraries();
  try {
    const int status = run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    std::fputs("hogline: the output can not be written: is the disk full?\n", stderr);
    return ExitStatus::failed;
  } catch (const hogline::config::ConfigError& e) {
    std::fprintf(stderr, "hogline: %s\n", e.what());
    return ExitStatus::wrong_use;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "hogline: %s\n", e.what());
    return ExitStatus::failed;
  }
}
