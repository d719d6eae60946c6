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

// The parser itself would take the next word for the value.
void check_equals(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") return;
    if (word.starts_with("--") && word.ends_with('=') && word.find('=') + 1 == word.size())
      throw config::ConfigError("command line", 0, word.substr(0, word.size() - 1), "''",
                                "is empty; leave the option out instead");
  }
}

void check_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const auto& values = option->results();
    if (std::ranges::none_of(values, [](const std::string& value) { return value.empty(); })) continue;
    throw config::ConfigError("command line", 0, option->get_name(), "''",
                              option->get_positional() ? "is empty: name a file"
                              : option->get_required() ? "is empty; it must be given"
                                                       : "is empty; leave the option out instead");
  }
}

std::string help_of(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "hogline --help" : "hogline " + chosen.front()->get_name() + " --help";
}

}  // namespace

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  check_first_word(app, argc, argv);
  check_equals(argc, argv);
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
