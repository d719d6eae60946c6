#include "tests/src/live/team_scene.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
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

Member::Member(std::string name, std::vector<std::string> command, const fs::path& folder)
    : name_(std::move(name)), command_(std::move(command)), output_(folder / (name_ + ".jsonl")) {}

Member::~Member() { end(); }

void Member::start() {
  if (running()) return;
  std::vector<char*> argv;
  for (std::string& word : command_) argv.push_back(word.data());
  argv.push_back(nullptr);
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output_.path().c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                   0644);
  const int error = posix_spawnp(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[0]);
  if (input_ >= 0) close(input_);
  input_ = pipe_ends[1];
  status_ = -1;
  if (error != 0) throw std::system_error(error, std::generic_category(), command_[0]);
}

bool Member::running() {
  if (pid_ < 0) return false;
  int wait_status = 0;
  if (waitpid(pid_, &wait_status, WNOHANG) == 0) return true;
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

TeamScene::TeamScene(const std::string& hogline)
    : folder_(own_folder()),
      domain_(1 + static_cast<std::uint32_t>(getpid()) % 200),
      thrower_rig_(rig("thrower", text_of(fs::path(HOGLINE_SOURCE_DIR) / "config/rigs/thrower.yaml"))),
      skip_rig_(rig("skip", text_of(thrower_rig_))),
      rink_("rink",
            {hogline, "rink", "--rig", thrower_rig_, "--camera-hz", std::to_string(camera_hz), "--truth",
             folder_ / "truth.jsonl"},
            folder_),
      thrower_("thrower", {hogline, "thrower", "--rig", thrower_rig_}, folder_),
      hand_("hand", {hogline, "hold", "--rig", thrower_rig_}, folder_),
      skip_("skip", {hogline, "order", "--rig", skip_rig_, "--stay"}, folder_),
      truth_file_(folder_ / "truth.jsonl") {}

TeamScene::~TeamScene() {
  for (Member* member : {&hand_, &skip_, &thrower_, &rink_}) member->end();
  std::error_code problem;
  fs::remove_all(folder_, problem);
}

// This run's own bus, port, lines and domain.
std::string TeamScene::rig(const std::string& name, const std::string& text) const {
  std::string own = text;
  const auto number = static_cast<unsigned>(getpid());
  if (name == "thrower") {
    replace(own, "group: 239.74.163.2", "group: 239.75." + std::to_string(1 + number % 250) + ".1");
    replace(own, "port: 50502", "port: " + std::to_string(21000 + number % 10000));
    for (const char* camera : {"near", "low"})
      replace(own, std::string("hogline-thrower-") + camera, "hogline-" + std::to_string(number) + "-" + camera);
    replace(own, "/tmp/hogline-thrower-gyro", folder_ / "gyro");
    replace(own, "/tmp/hogline-thrower-operator", folder_ / "operator");
    replace(own, "domain: 7", "domain: " + std::to_string(domain_));
  } else {
    replace(own, "robot: thrower", "robot: skip");
    replace(own, "peers: [skip]", "peers: [thrower]");
  }
  const fs::path path = folder_ / (name + ".yaml");
  std::ofstream(path) << own;
  return path;
}

const std::vector<TrueMoment>& TeamScene::truth() {
  for (const std::string& line : truth_file_.news()) {
    const json j = json::parse(line, nullptr, false);
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
  if (!wait_until(thrower_waits, 30s)) return false;
  const Stamp asked = now();
  rink_.say("again");
  return wait_until([&] { return rink_.told_since(asked, "again").has_value(); }, 30s);
}

}  // namespace hogline::live_test
