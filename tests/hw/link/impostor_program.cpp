// A coach with keys of his own who speaks under the skip's name, fifty times a second: heartbeats, and stops taken
// back.
//   impostor_program DOMAIN KEYS_FOLDER [PARTITION ...]
// His writers are in these partitions ("-": the one without a name). "forbidden": DDS does not make them. It runs until
// it is killed or its parent is gone.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "hw/link/dds_domain.hpp"
#include "hw/link/dds_qos.hpp"
#include "hw/link/link_error.hpp"
#include "hw/link/topics.hpp"
#include "hw/link/wire_messages.hpp"

using namespace hogline::hw;
using namespace hogline::hw::link;

namespace {

std::int32_t writer(std::int32_t participant, std::size_t kind, const std::vector<const char*>& partitions) {
  const Topic& topic = topics()[kind];
  const Qos qos = writer_qos(topic, {});
  if (!partitions.empty())
    dds_qset_partition(qos.get(), static_cast<std::uint32_t>(partitions.size()),
                       const_cast<const char**>(partitions.data()));
  const std::int32_t handle =
      dds_create_topic(participant, topic.type, std::string(topic.name).c_str(), nullptr, nullptr);
  return dds_create_writer(participant, handle, qos.get(), nullptr);
}

void say(std::int32_t from, TeamMessage message) {
  static std::uint64_t serial = 0;
  const TeamTime now{std::chrono::system_clock::now().time_since_epoch()};
  std::visit([&](auto& m) { m.origin = {.robot = "skip", .session = 1, .serial = ++serial, .stamp = now}; }, message);
  with_wire(message, [&](const void* sample) { dds_write(from, sample); });
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  LinkConfig config;
  config.robot = "coach";
  config.domain = static_cast<std::uint32_t>(std::strtoul(arguments[1], nullptr, 10));
  config.security = LinkSecurity{.folder = arguments[2]};
  std::vector<const char*> partitions;
  for (int i = 3; i < count; ++i) partitions.push_back(arguments[i] == std::string("-") ? "" : arguments[i]);
  const auto domain = DdsDomain::open(config.domain, cyclone_xml(config), true);
  const std::int32_t participant = dds_create_participant(config.domain, participant_qos(config).get(), nullptr);
  const HeartbeatMessage beat;
  EmergencyStopMessage back;
  back.pressed = false;
  back.reason = "not mine";
  const std::int32_t beats = writer(participant, TeamMessage(beat).index(), partitions);
  const std::int32_t stops = writer(participant, TeamMessage(back).index(), partitions);
  if (beats < 0 || stops < 0) {
    std::printf("%s\n", beats == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY ? "forbidden" : dds_strretcode(beats));
    return 1;
  }
  for (const pid_t parent = getppid(); getppid() == parent;
       std::this_thread::sleep_for(std::chrono::milliseconds{20})) {
    say(beats, beat);
    say(stops, back);
    std::printf("spoken\n");
  }
}
