// The subcommands' options, help and examples: what stands on the command line, and which function it leads to.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace hogline::cli {

/// What the command line asked for; gives the exit status.
using Chosen = std::function<int()>;

void add_pose(CLI::App& app, Chosen& chosen);
void add_stones(CLI::App& app, Chosen& chosen);
void add_board(CLI::App& app, Chosen& chosen);
void add_throw(CLI::App& app, Chosen& chosen);
void add_demo(CLI::App& app, Chosen& chosen);
void add_turn(CLI::App& app, Chosen& chosen);
void add_doctor(CLI::App& app, Chosen& chosen);
void add_game(CLI::App& app, Chosen& chosen);
void add_faults(CLI::App& app, Chosen& chosen);
void add_campaign(CLI::App& app, Chosen& chosen);
void add_sights(CLI::App& app, Chosen& chosen);
void add_skip(CLI::App& app, Chosen& chosen);
void add_track(CLI::App& app, Chosen& chosen);
void add_skips(CLI::App& app, Chosen& chosen);
void add_keys(CLI::App& app, Chosen& chosen);
void add_link(CLI::App& app, Chosen& chosen);
void add_rink(CLI::App& app, Chosen& chosen);
void add_thrower(CLI::App& app, Chosen& chosen);
void add_order(CLI::App& app, Chosen& chosen);
void add_hold(CLI::App& app, Chosen& chosen);

}  // namespace hogline::cli
