#include "src/cli/parsing.hpp"

#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "src/config/config_error.hpp"
#include "src/config/nearest_word.hpp"

namespace hogline::cli {
namespace {

// The parser itself would only say that a subcommand is required.
void check_first_word(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) return;
  const std::string word = argv[1];
  std::vector<std::string> known;
  if (word.starts_with('-')) {
    known = {"--help", "-h", "--version"};
  } else {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  }
  if (std::ranges::find(known, word) != known.end()) return;
  const std::string meant = config::nearest_word(word, known);
  throw config::ConfigError("command line", 0, word.starts_with('-') ? "option" : "subcommand", word,
                            fmt::format("unknown; {}there are {}", meant.empty() ? "" : "did you mean " + meant + "? ",
                                        fmt::join(known, ", ")));
}

void check_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const auto& values = option->results();
    if (std::ranges::any_of(values, [](const std::string& value) { return value.empty(); }))
      throw config::ConfigError("command line", 0, option->get_name(), "''", "is empty; leave the option out instead");
  }
}

std::string help_of(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "hogline --help" : "hogline " + chosen.front()->get_name() + " --help";
}

}  // namespace

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  check_first_word(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& wrong) {
    throw config::ConfigError("command line", 0, "", "", fmt::format("{}; see '{}'", wrong.what(), help_of(app)));
  }
  for (const CLI::App* command : app.get_subcommands()) check_values(*command);
  return std::nullopt;
}

}  // namespace hogline::cli
