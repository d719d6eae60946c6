// A serial line of the simulated rink: a pseudo terminal behind a path that another program opens as its serial port.
#pragma once

#include <string>

namespace hogline {

class PtyLine {
 public:
  /// `path` becomes a link to the terminal's other end. A link to a terminal that was left there is replaced; anything
  /// else that stands there is not touched. Throws std::runtime_error.
  explicit PtyLine(const std::string& path);
  ~PtyLine();
  PtyLine(const PtyLine&) = delete;
  PtyLine& operator=(const PtyLine&) = delete;

  /// What has arrived and was not read before.
  std::string read() const;
  /// What nobody reads is lost, as on a wire.
  void write(const std::string& bytes) const;

 private:
  std::string path_;
  std::string target_;
  int descriptor_ = -1;
  int other_ = -1;  ///< held open, so that the other program may come and go
};

}  // namespace hogline
