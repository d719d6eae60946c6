// What the program's exit status means, the same for every subcommand.
#pragma once

namespace hogline {

struct ExitStatus {
  static constexpr int success = 0;       ///< all that was asked for was done
  static constexpr int not_achieved = 1;  ///< something could not be estimated or thrown; the output says what and why
  static constexpr int wrong_use = 2;     ///< wrong arguments, configuration or files; stderr says what is allowed
  static constexpr int failed = 3;        ///< something outside gave way: a disk, a port; stderr says what
};

}  // namespace hogline
