#include "src/doctor/camera_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hw/checks/checked_camera.hpp"
#include "hw/files/recorded_camera.hpp"

namespace hogline::doctor {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t enough = 12;
constexpr Duration longest = 15s;  // three starts without a frame, and the search before
constexpr Duration tick = 5ms;

struct Look {
  std::vector<double> ages_s;
  Stamp first{};
  Stamp last{};
  std::uint64_t first_id = 0;
  std::uint64_t last_id = 0;
};

void note(const hw::Frame& frame, Stamp now, Look& seen) {
  if (seen.ages_s.empty()) {
    seen.first = frame.stamp;
    seen.first_id = frame.id;
  }
  seen.last = frame.stamp;
  seen.last_id = frame.id;
  seen.ages_s.push_back(seconds(now - frame.stamp));
}

Look look(hw::CheckedCamera& camera, Site& site) {
  Look seen;
  const Stamp end = site.now() + longest;
  while (site.now() < end && seen.ages_s.size() < enough && !camera.error()) {
    const Stamp now = site.now();
    if (const auto frame = camera.latest(now)) note(*frame, now, seen);
    site.pass(tick);
  }
  std::ranges::sort(seen.ages_s);
  return seen;
}

// A recording is looked at in its own time: how fast this machine decodes says nothing about it.
Look look(hw::CheckedCamera& camera, const hw::files::RecordedCamera& recording) {
  Look seen;
  for (auto now = recording.next_stamp(); now && seen.ages_s.size() < enough && !camera.error();
       now = recording.next_stamp()) {
    if (const auto frame = camera.latest(*now)) note(*frame, *now, seen);
  }
  return seen;
}

// To the end, or as far as there is patience for: a file whose end is missing plays well until there.
void examine_length(hw::files::RecordedCamera& recording, Finding& finding) {
  constexpr auto patience = 20s;
  const auto promised = recording.promised_frames();
  if (!promised) return;
  const auto end = std::chrono::steady_clock::now() + patience;
  std::uint64_t last = 0;
  for (auto now = recording.next_stamp(); now; now = recording.next_stamp()) {
    if (std::chrono::steady_clock::now() > end) return;
    if (const auto frame = recording.latest(*now)) last = frame->id + 1;
    if (recording.error()) break;
  }
  finding.values.emplace_back("frames", static_cast<std::int64_t>(last));
  const std::uint64_t tolerated = 2 + *promised / 100;  // containers round
  if (const auto error = recording.error()) {
    finding.wrong(fmt::format("frame {} of {}: {}", last + 1, *promised, error->what),
                  "copy it whole, or record it again");
  } else if (last + tolerated < *promised) {
    finding.wrong(fmt::format("is cut short: {} of {} frames can be played", last, *promised),
                  "copy it whole, or record it again");
  }
}

void describe(const Look& seen, Finding& finding) {
  if (seen.ages_s.empty()) return;
  const double age_ms = 1e3 * seen.ages_s[seen.ages_s.size() / 2];
  finding.found += fmt::format(", age {:.0f} ms", age_ms);
  finding.values.emplace_back("age_ms", age_ms);
  finding.values.emplace_back("worst_age_ms", 1e3 * seen.ages_s.back());
  if (seen.last_id <= seen.first_id) return;
  const double rate_hz = static_cast<double>(seen.last_id - seen.first_id) / seconds(seen.last - seen.first);
  finding.found += fmt::format(", {:.1f} pictures/s", rate_hz);
  finding.values.emplace_back("rate_hz", rate_hz);
}

std::string advice_for(hw::DeviceErrorKind kind, const std::string& of_the_site) {
  if (!of_the_site.empty()) return of_the_site;
  switch (kind) {
    case hw::DeviceErrorKind::disconnected:
      return "check its power and cable, and its address against the network card's";
    case hw::DeviceErrorKind::timeout:
      return "check the cable, the packet size against the network card's MTU, the firewall and the trigger";
    case hw::DeviceErrorKind::refused:
      return "set the camera or the rig so that they agree (doc/cameras.md)";
    default:
      return "look at its picture, its lens and cover, and at the rig's camera section";
  }
}

}  // namespace

Finding examine_camera(const std::string& name, const config::CameraSource& source, bool covered, Site& site) {
  Finding finding;
  finding.device = name + " camera";
  finding.line = site.camera_line(name);
  hw::Camera* camera = site.camera(name);
  if (camera == nullptr) {
    finding.found = "not examined";
    finding.note("its pictures are simulated",
                 "name its source in the rig; a whole thrower can be examined with --simulated");
    return finding;
  }
  hw::CheckedCamera checked(*camera, {.name = finding.device,
                                      .max_age = source.max_age,
                                      .silence_limit = source.silence_limit,
                                      .first_frame_limit = longest});
  auto* recording = dynamic_cast<hw::files::RecordedCamera*>(camera);
  const Look seen = recording != nullptr ? look(checked, *recording) : look(checked, site);
  const auto& verdict = checked.verdict();
  finding.found = verdict ? "picture with " + verdict->describe() : "no picture";
  if (verdict && verdict->fault) finding.found = verdict->describe();
  site.describe_camera(name, finding);
  describe(seen, finding);
  if (recording != nullptr && !checked.error()) examine_length(*recording, finding);

  const auto error = checked.error();
  const bool black = verdict && verdict->fault == vision::PictureFault::black;
  if (black && covered) {
    finding.note("sees darkness: the head is folded", "unfold the arm and ask again");
  } else if (error) {
    finding.wrong(fmt::format("{}: {}", to_string(error->kind), error->what),
                  advice_for(error->kind, site.camera_advice(name)));
  } else if (seen.ages_s.size() < (recording != nullptr ? 1 : enough)) {
    finding.wrong(fmt::format("only {} pictures in {:.0f} s", seen.ages_s.size(), seconds(longest)),
                  advice_for(hw::DeviceErrorKind::timeout, site.camera_advice(name)));
  }
  return finding;
}

}  // namespace hogline::doctor
