#include "tests/src/live/team_scene.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace hogline::live_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int camera_hz = 15;
constexpr int skip_hz = 4;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the rig does not say " + from);
  text.replace(at, from.size(), to);
}

fs::path own_folder() {
  const fs::path folder = fs::temp_directory_path() / ("hogline-team-" + std::to_string(getpid()));
  fs::create_directories(folder);
  return folder;
}

std::vector<TrueStone> stones_of(const json& line) {
  std::vector<TrueStone> stones;
  for (const json& stone : line.at("stones"))
    stones.push_back({stone.at("x_m").get<double>(), stone.at("y_m").get<double>(), stone.at("thrown").get<bool>(),
                      stone.at("team").get<int>()});
  return stones;
}

// Below those that the kernel gives to outgoing lines; two of them.
int strategist_port() { return 11000 + 2 * (static_cast<int>(getpid()) % 4500); }

std::vector<std::string> client_command(int port, const std::string& name, bool waits) {
  std::vector<std::string> command{"python3", HOGLINE_SOURCE_DIR "/tests/peers/digital_curling_client.py",
                                   std::to_string(port), name};
  if (waits) command.emplace_back("late");
  return command;
}

Stamp stamp_of(double s) { return Stamp{from_seconds(s)}; }

}  // namespace

Stamp now() { return std::chrono::steady_clock::now(); }

bool wait_until(const std::function<bool()>& holds, Duration limit) {
  for (const Stamp end = now() + limit; now() < end; std::this_thread::sleep_for(5ms))
    if (holds()) return true;
  return holds();
}

std::vector<std::string> GrowingFile::news() {
  std::ifstream file(path_);
  file.seekg(read_);
  std::string more{std::istreambuf_iterator<char>(file), {}};
  read_ += static_cast<std::streamoff>(more.size());
  rest_ += more;
  std::vector<std::string> lines;
  for (auto end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
    lines.push_back(rest_.substr(0, end));
    rest_.erase(0, end + 1);
  }
  return lines;
}

Member::Member(std::string name, std::vector<std::string> command, const fs::path& folder,
               std::vector<std::string> environment, MachineWatch* watch)
    : name_(std::move(name)),
      command_(std::move(command)),
      environment_(std::move(environment)),
      watch_(watch),
      output_(folder / (name_ + ".jsonl")) {}

Member::~Member() { end(); }

// Between fork and exec nothing may be called but what a signal handler may call.
void Member::start() {
  if (running()) return;
  std::vector<char*> argv, envp;
  for (std::string& word : command_) argv.push_back(word.data());
  for (std::string& word : environment_) envp.push_back(word.data());
  for (char** word = environ; *word != nullptr; ++word) envp.push_back(*word);
  argv.push_back(nullptr);
  envp.push_back(nullptr);
  int pipe_ends[2];
  constexpr int appending = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC;
  const int output = open(output_.path().c_str(), appending, 0644);
  const int errors = open((output_.path() + ".err").c_str(), appending, 0644);
  if (output < 0 || errors < 0 || pipe2(pipe_ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), name_);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const bool orphan = getppid() != parent;
    if (!orphan && dup2(pipe_ends[0], STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0 &&
        dup2(errors, STDERR_FILENO) >= 0)
      execvpe(argv[0], argv.data(), envp.data());
    _exit(127);
  }
  close(pipe_ends[0]);
  close(output);
  close(errors);
  if (input_ >= 0) close(input_);
  input_ = pipe_ends[1];
  status_ = -1;
  if (watch_ != nullptr) watch_->follow(name_, pid_);
}

bool Member::running() {
  if (pid_ < 0) return false;
  int wait_status = 0;
  if (waitpid(pid_, &wait_status, WNOHANG) == 0 || WIFSTOPPED(wait_status)) return true;
  status_ = WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
  pid_ = -1;
  return false;
}

void Member::signal(int number) {
  if (running()) kill(pid_, number);
}

void Member::end() {
  signal(SIGCONT);
  signal(SIGTERM);
  if (!wait_until([this] { return !running(); }, 20s)) {
    signal(SIGKILL);
    wait_until([this] { return !running(); }, 20s);
  }
  if (input_ >= 0) close(input_);
  input_ = -1;
}

void Member::say(const std::string& line) const {
  const std::string whole = line + "\n";
  if (::write(input_, whole.data(), whole.size()) < 0) return;
}

const std::vector<Told>& Member::told() {
  for (const std::string& line : output_.news()) {
    const json j = json::parse(line, nullptr, false);
    if (!j.is_object() || !j.contains("t_s")) continue;
    told_.push_back(
        {stamp_of(j.at("t_s").get<double>()), j.at("event").get<std::string>(), j.at("what").get<std::string>()});
  }
  return told_;
}

std::optional<Told> Member::told_since(Stamp since, const std::string& event) {
  for (const Told& t : told())
    if (t.at >= since && t.event == event) return t;
  return std::nullopt;
}

std::string all_of(Member& member) {
  std::string text;
  for (const Told& t : member.told()) text += member.name() + ": " + t.event + ": " + t.what + "\n";
  return text;
}

// The control loops' period is 5 ms, their drives' patience for feedback 50 ms; pictures may be some periods of a
// camera old. What is waited before shows later: whoever asks, asks of a whole attempt.
bool TeamScene::was_late(Stamp from, Stamp until) const {
  constexpr Duration control_limit = 15ms, picture_limit = 40ms;
  const Duration control = watch_.longest(true, from, until), any = watch_.longest(false, from, until);
  std::fprintf(stderr,
               "of these %.1f s a control loop, or a whole processor, lost up to %.1f ms at once; any thread %.1f ms\n",
               seconds(until - from), 1e3 * seconds(control), 1e3 * seconds(any));
  return control >= control_limit || any >= picture_limit;
}

TeamScene::TeamScene(const std::string& hogline, const SceneOptions& options)
    : hogline_(hogline),
      options_(options),
      folder_(own_folder()),
      domain_(1 + static_cast<std::uint32_t>(getpid()) % 200),
      thrower_rig_(keep("thrower", thrower_rig())),
      skip_rig_(keep("skip", options.whole_skip ? skip_rig() : order_rig())),
      rink_("rink", rink_command(), folder_, {}, &watch_),
      thrower_("thrower", {hogline, "thrower", "--rig", thrower_rig_}, folder_, options.thrower_environment, &watch_),
      hand_("hand", {hogline, "hold", "--rig", thrower_rig_}, folder_),
      skip_("skip", skip_command(), folder_, options.skip_environment, &watch_),
      strategist_("strategist", client_command(strategist_port(), "client", options.strategist_waits), folder_),
      second_strategist_("second-strategist", client_command(strategist_port() + 1, "other", false), folder_),
      truth_file_(folder_ / "truth.jsonl") {
  if (options.secure) make_keys("keys");
}

void TeamScene::make_keys(const std::string& name) const {
  Member keys("keys",
              {hogline_, "keys", "--out", folder_ / name, "--domain", std::to_string(domain_), "--observer", "coach"},
              folder_);
  keys.start();
  wait_until([&] { return !keys.running(); }, 20s);
  if (keys.status() != 0) throw std::runtime_error("no keys were made");
}

std::vector<std::string> TeamScene::rink_command() const {
  std::vector<std::string> command{hogline_, "rink", "--rig", thrower_rig_, "--truth", folder_ / "truth.jsonl"};
  for (const std::string& word : {std::string("--camera-hz"), std::to_string(camera_hz)}) command.push_back(word);
  if (!options_.whole_skip) return command;
  for (const std::string& word :
       {std::string("--skip-rig"), skip_rig_, std::string("--skip-hz"), std::to_string(skip_hz)})
    command.push_back(word);
  return command;
}

std::vector<std::string> TeamScene::skip_command() const {
  std::vector<std::string> command{hogline_, "order", "--rig", skip_rig_, "--stay"};
  if (options_.whole_skip) command = {hogline_, "skip", "--live", "--rig", skip_rig_};
  if (options_.strategists > 0) {
    for (const std::string& word :
         {std::string("--thrower-rig"), thrower_rig_, std::string("--team0"), "dc:" + std::to_string(strategist_port()),
          std::string("--thinking"), std::string("15"), std::string("--out"), (folder_ / "game").string()})
      command.push_back(word);
  }
  if (options_.strategists > 1) {
    command.emplace_back("--team1");
    command.push_back("dc:" + std::to_string(strategist_port() + 1));
  }
  command.insert(command.end(), options_.skip_arguments.begin(), options_.skip_arguments.end());
  return command;
}

TeamScene::~TeamScene() {
  for (Member* member : {&hand_, &strategist_, &second_strategist_, &skip_, &thrower_, &rink_}) member->end();
  std::error_code problem;
  fs::remove_all(folder_, problem);
}

// This run's own bus, port, lines and domain.
std::string TeamScene::thrower_rig() const {
  std::string rig = own(text_of(fs::path(HOGLINE_SOURCE_DIR) / "config/rigs/thrower.yaml"));
  const auto number = static_cast<unsigned>(getpid());
  replace(rig, "group: 239.74.163.2", "group: 239.75." + std::to_string(1 + number % 250) + ".1");
  replace(rig, "port: 15502", "port: " + std::to_string(21000 + number % 10000));
  replace(rig, "/tmp/hogline-thrower-gyro", folder_ / "gyro");
  replace(rig, "/tmp/hogline-thrower-operator", folder_ / "operator");
  return rig;
}

std::string TeamScene::order_rig() const {
  std::string rig = thrower_rig();
  replace(rig, "robot: thrower", "robot: skip");
  replace(rig, "peers: [skip]", "peers: [thrower]");
  return rig;
}

std::string TeamScene::skip_rig() const {
  std::string rig = own(text_of(fs::path(HOGLINE_SOURCE_DIR) / "config/rigs/skip_live.yaml"));
  const auto number = static_cast<unsigned>(getpid());
  replace(rig, "group: 239.74.163.3", "group: 239.75." + std::to_string(1 + number % 250) + ".2");
  return rig;
}

std::string TeamScene::own(const std::string& rig) const {
  std::string text = rig;
  for (const char* camera : {"thrower-near", "thrower-low", "skip-near", "skip-far"}) {
    const std::string segment = std::string("hogline-") + camera;
    if (text.find(segment) == std::string::npos) continue;
    replace(text, segment, "hogline-" + std::to_string(getpid()) + "-" + camera);
  }
  replace(text, "domain: 7", "domain: " + std::to_string(domain_));
  if (options_.secure) text += "\n  security_folder: " + (folder_ / "keys").string() + "\n";
  return text;
}

std::string TeamScene::keep(const std::string& name, const std::string& rig) const {
  const fs::path path = folder_ / (name + ".yaml");
  std::ofstream(path) << rig;
  return path;
}

const std::vector<TrueMoment>& TeamScene::truth() {
  for (const std::string& line : truth_file_.news()) {
    const json j = json::parse(line, nullptr, false);
    if (j.is_object() && j.contains("rest_ns")) rests_.push_back(stones_of(j));
    if (!j.is_object() || !j.contains("t_ns")) continue;
    const bool base = j.at("moves").get<bool>();
    truth_.push_back({.at = Stamp{Duration{j.at("t_ns").get<std::int64_t>()}},
                      .moves = base || j.at("arm_moves").get<bool>(),
                      .base_moves = base,
                      .speed_mps = j.at("speed_mps").get<double>(),
                      .y_m = j.at("y_m").get<double>(),
                      .held = j.at("held").get<bool>(),
                      .released = j.at("released").get<bool>()});
  }
  return truth_;
}

bool TeamScene::set_up() {
  hand_.end();
  strategist_.end();
  second_strategist_.end();
  skip_.end();
  rink_.start();
  if (!wait_until([this] { return rink_.running() && !truth().empty() && now() - truth_.back().at < 1s; }, 30s))
    return false;
  thrower_.start();
  const auto thrower_waits = [this] {
    std::string last;
    for (const Told& t : thrower_.told())
      if (t.event == "session" || t.event == "disarmed" || t.event == "arming" || t.event == "armed" ||
          t.event == "throwing") {
        last = t.event;
      }
    return last == "session" || last == "disarmed";
  };
  return wait_until(thrower_waits, 30s) && put_back("again 0");
}

bool TeamScene::put_back(const std::string& order) {
  const Stamp begin = now();
  std::optional<Stamp> asked;
  const auto put = [&] {
    if (rink_.told_since(begin, "again")) return true;
    if (!asked || rink_.told_since(*asked, "refused")) {
      asked = now();
      rink_.say(order);
    }
    return false;
  };
  return wait_until(put, 60s);
}

bool TeamScene::skip_is_heard() {
  skip_.start();
  const auto heard = [&] {
    std::string last;
    for (const Told& t : skip_.told())
      if (t.event == "session" || t.event == "heard" || t.event == "silent") last = t.event;
    return last == "heard";
  };
  return wait_until(heard, 30s);
}

bool TeamScene::skip_waits() {
  if (!skip_is_heard()) return false;
  const Stamp begin = now();
  skip_.say("begin");
  const auto waits = [&] {
    return std::ranges::any_of(skip_.told(),
                               [&](const Told& t) { return t.at >= begin && t.event == "state" && t.what == "wait"; });
  };
  return wait_until([&] { return waits() || skip_.told_since(begin, "stopped"); }, 30s) && waits();
}

bool TeamScene::begin_game() {
  if (!skip_is_heard()) return false;
  strategist_.end();
  second_strategist_.end();
  const Stamp begin = now();
  skip_.say("play");
  if (!wait_until([&] { return skip_.told_since(begin, "table").has_value(); }, 30s)) return false;
  strategist_.start();
  if (options_.strategists > 1) second_strategist_.start();
  return wait_until([&] { return skip_.told_since(begin, "asked").has_value(); }, 30s);
}

}  // namespace hogline::live_test
