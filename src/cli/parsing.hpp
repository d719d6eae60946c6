// Wrong words on the command line, refused in one line that says what is allowed.
#pragma once

#include <CLI/App.hpp>
#include <optional>

namespace hogline::cli {

/// Parses. The exit status where there is nothing more to do: --help and --version have been printed. Throws
/// ConfigError for wrong use. An option whose value is empty is wrong use: in scripts that is a variable that was never
/// set.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

}  // namespace hogline::cli
