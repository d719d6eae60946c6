// The programs that make a team, each in a process of its own, and what they and the rink's truth have said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/src/live/machine_watch.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::live_test {

using namespace std::chrono_literals;

Stamp now();

/// Until it holds, or the time is over: whether it does.
bool wait_until(const std::function<bool()>& holds, Duration limit);

/// One line that a program has told.
struct Told {
  Stamp at{};
  std::string event;
  std::string what;
};

/// One moment of the rink's truth.
struct TrueMoment {
  Stamp at{};
  bool moves = false;  ///< body, wheels or arm
  bool base_moves = false;
  double speed_mps = 0.0;
  double y_m = 0.0;
  bool held = false;
  bool released = false;
};

/// A stone that lies on the sheet when all have come to rest, by the rink's truth: e of the skip.
struct TrueStone {
  double x_m = 0.0;
  double y_m = 0.0;
  bool thrown = false;
  int team = 0;
};

/// Lines of a file that grows, each read once.
class GrowingFile {
 public:
  explicit GrowingFile(std::string path) : path_(std::move(path)) {}
  std::vector<std::string> news();
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::streamoff read_ = 0;
  std::string rest_;
};

/// A program of the team: its stdout and stderr go to files, its stdin is a pipe. It dies with whoever started it,
/// however that ends.
class Member {
 public:
  /// `watch`: is told of each start; must outlive it.
  Member(std::string name, std::vector<std::string> command, const std::filesystem::path& folder,
         std::vector<std::string> environment = {}, MachineWatch* watch = nullptr);
  ~Member();
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  /// No effect while it runs.
  void start();
  bool running();
  pid_t pid() const { return pid_; }
  void signal(int number);
  /// Asks it to end, and kills it when it does not.
  void end();
  void say(const std::string& line) const;

  const std::string& name() const { return name_; }
  /// All that it has told since its first start, and where it was last read.
  const std::vector<Told>& told();
  std::optional<Told> told_since(Stamp since, const std::string& event);
  /// The last exit status; -1 while it runs.
  int status() const { return status_; }

 private:
  std::string name_;
  std::vector<std::string> command_;
  std::vector<std::string> environment_;  ///< beside our own
  MachineWatch* watch_;
  GrowingFile output_;
  std::vector<Told> told_;
  pid_t pid_ = -1;
  int input_ = -1;
  int status_ = -1;
};

struct SceneOptions {
  bool secure = false;  ///< the robots have keys that `hogline keys` makes
  bool whole_skip =
      false;  ///< the skip is `hogline skip --live`; else `hogline order`, which orders one shot and stays
  std::vector<std::string> thrower_environment{};
  std::vector<std::string> skip_environment{};
  std::vector<std::string> skip_arguments{};
  int strategists = 0;           ///< Digital Curling clients at the skip's table: none, for the first team, for both
  bool strategist_waits = true;  ///< the first team's thinks in its first turn until it is told to move
};

/// All that it has told, a line each, for whoever wants to know why.
std::string all_of(Member& member);

/// Rink, thrower, its operator's hand, and a skip: with lines of this run's own.
class TeamScene {
 public:
  /// `hogline`: the program. The folder is made and removed.
  explicit TeamScene(const std::string& hogline, const SceneOptions& options = {});
  ~TeamScene();

  Member& rink() { return rink_; }
  Member& thrower() { return thrower_; }
  Member& hand() { return hand_; }
  Member& skip() { return skip_; }
  Member& strategist() { return strategist_; }
  Member& second_strategist() { return second_strategist_; }
  std::uint32_t domain() const { return domain_; }
  const std::string& skip_rig_file() const { return skip_rig_; }
  /// Keys of a team of this domain, in a folder of this name; also those of a coach.
  void make_keys(const std::string& name) const;
  const std::filesystem::path& folder() const { return folder_; }

  /// The truth of all that has happened; grows.
  const std::vector<TrueMoment>& truth();
  /// What lay where, each time that all had come to rest; as far as truth() has been read.
  const std::vector<std::vector<TrueStone>>& rests() const { return rests_; }
  /// The robot stands in the hack with a stone, everybody is there, nobody holds the switch.
  bool set_up();
  /// The robot goes back to the hack for its next stone, by this order to the rink, which refuses it as long as a stone
  /// of the turn before still runs: it is asked until it is done. False: it does not come to that.
  bool put_back(const std::string& order);
  /// The skip that is one has looked, waits for a stone, and hears the thrower. False: it does not come to that.
  bool skip_waits();
  /// The skip plays, and its strategists sit at its table. False: it does not come to that.
  bool begin_game();
  /// The kernel says that the machine kept a control loop, or whoever renders or looks at pictures, waiting for longer
  /// than the rink's clock forgives: what was given up between the two shows nothing of the programs.
  bool was_late(Stamp from, Stamp until) const;

 private:
  bool skip_is_heard();
  std::string thrower_rig() const;
  std::string order_rig() const;
  std::string skip_rig() const;
  std::string keep(const std::string& name, const std::string& rig) const;
  std::vector<std::string> rink_command() const;
  std::vector<std::string> skip_command() const;
  /// This run's own words in the place of the rig's.
  std::string own(const std::string& rig) const;

  std::string hogline_;
  SceneOptions options_;
  std::filesystem::path folder_;
  std::uint32_t domain_;
  std::string thrower_rig_;
  std::string skip_rig_;  ///< of whoever orders
  MachineWatch watch_;
  Member rink_;
  Member thrower_;
  Member hand_;
  Member skip_;
  Member strategist_;
  Member second_strategist_;
  GrowingFile truth_file_;
  std::vector<TrueMoment> truth_;
  std::vector<std::vector<TrueStone>> rests_;
};

}  // namespace hogline::live_test
