#include "hw/link/dds_team_link.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hw/link/dds_qos.hpp"
#include "hw/link/topics.hpp"
#include "hw/link/wire_messages.hpp"

namespace hogline::hw::link {
namespace {

constexpr std::int32_t forbidden = 0;  // no handle of DDS's
constexpr std::size_t emergency_stop = std::variant_size_v<TeamMessage> - 1;

// A handle of Cyclone DDS's, or the reason why there is none.
std::int32_t made(std::int32_t handle, const std::string& what) {
  if (handle < 0) throw LinkError(fmt::format("{}: {}", what, dds_strretcode(handle)));
  return handle;
}

}  // namespace

DdsTeamLink::DdsTeamLink(const LinkConfig& config, Stamp now, TeamTime utc_now)
    : robot_(config.robot), start_(now), utc_start_(utc_now), secure_(config.security.has_value()) {
  if (const std::string missing = missing_key_file(config); !missing.empty()) throw LinkError(missing);
  state_.session = static_cast<std::uint64_t>(utc_now.time_since_epoch() / std::chrono::microseconds{1});
  try {
    open(config);
  } catch (const LinkError&) {
    dds_delete(participant_);
    throw;
  }
}

DdsTeamLink::~DdsTeamLink() { dds_delete(participant_); }

void DdsTeamLink::open(const LinkConfig& config) {
  try {
    domain_ = DdsDomain::open(config.domain, cyclone_xml(config), config.security.has_value());
  } catch (const LinkError& error) {
    throw LinkError(
        fmt::format("{}; is '{}' a network interface of this machine that is up?", error.what(), config.interface));
  }
  participant_ = made(dds_create_participant(config.domain, participant_qos(config).get(), nullptr),
                      config.security ? fmt::format("a participant with the keys in {}", config.security->folder)
                                      : fmt::format("a participant on interface '{}'", config.interface));
  for (std::size_t kind = 0; kind < ends_.size(); ++kind) {
    const Topic& topic = topics()[kind];
    const std::string name(topic.name);
    const std::int32_t handle =
        made(dds_create_topic(participant_, topic.type, name.c_str(), nullptr, nullptr), "topic " + name);
    const std::int32_t writer = dds_create_writer(
        participant_, handle, writer_qos(topic, config.security ? config.robot : std::string()).get(), nullptr);
    if (writer == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY && topic.heartbeat) {
      throw LinkError(fmt::format(
          "the keys in {} do not let '{}' say that it is there: make new ones with 'hogline keys', for all robots",
          config.security->folder, robot_));
    }
    ends_[kind].writer = writer == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY ? forbidden : made(writer, "writing " + name);
    ends_[kind].reader =
        made(dds_create_reader(participant_, handle, reader_qos(topic).get(), nullptr), "reading " + name);
  }
}

void DdsTeamLink::latch(Stamp now, std::string what) {
  if (state_.error) return;
  state_.error = {
      .kind = DeviceErrorKind::disconnected, .device = "link of " + robot_, .what = std::move(what), .since = now};
}

TeamSendResult DdsTeamLink::send(TeamMessage message, Stamp at) {
  Ends& ends = ends_[message.index()];
  std::visit(
      [&](auto& m) {
        m.origin = {.robot = robot_, .session = state_.session, .serial = ends.serial + 1, .stamp = team_time(at)};
      },
      message);
  if (ends.writer == forbidden) return TeamSendResult::forbidden;
  dds_return_t result = DDS_RETCODE_OK;
  const bool written = with_wire(message, [&](const void* sample) { result = dds_write(ends.writer, sample); });
  if (!written) return TeamSendResult::refused;
  if (result != DDS_RETCODE_OK) {
    latch(at, fmt::format("writing {}: {}", topics()[message.index()].name, dds_strretcode(result)));
    return TeamSendResult::down;
  }
  ++ends.serial;
  ++state_.sent;
  return TeamSendResult::sent;
}

std::optional<TeamMessage> DdsTeamLink::take(std::size_t kind) {
  void* sample = nullptr;
  dds_sample_info_t info;
  while (dds_take(ends_[kind].reader, &sample, &info, 1, 1) == 1) {
    std::optional<TeamMessage> message = info.valid_data ? topics()[kind].decode(sample) : std::nullopt;
    dds_return_loan(ends_[kind].reader, &sample, 1);
    sample = nullptr;
    if (message && may_say(kind, info.publication_handle, *message)) return message;
    if (info.valid_data) ++(message ? state_.impostors : state_.malformed);
  }
  return std::nullopt;
}

// DDS Security binds a writer's topic and partitions to its identity, not what it says. A writer that was gone before
// its first message was read speaks for nobody; but whoever of the team calls a stop stops, under whatever name.
bool DdsTeamLink::may_say(std::size_t kind, std::uint64_t writer, const TeamMessage& message) {
  constexpr std::size_t most_writers = 1000;
  const auto* stop = std::get_if<EmergencyStopMessage>(&message);
  if (!secure_ || (stop != nullptr && stop->pressed)) return true;
  auto known = names_.find(writer);
  if (known == names_.end()) {
    dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(ends_[kind].reader, writer);
    if (endpoint == nullptr) return false;
    if (names_.size() >= most_writers) names_.clear();
    known = names_.emplace(writer, names_of(endpoint->qos)).first;
    dds_builtintopic_free_endpoint(endpoint);
  }
  return std::ranges::find(known->second, origin_of(message).robot) != known->second.end();
}

std::optional<ReceivedMessage> DdsTeamLink::receive(Stamp now) {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    // An emergency stop overtakes everything.
    if (auto message = take(emergency_stop - i)) {
      ++state_.received;
      return ReceivedMessage{.message = std::move(*message), .received = now};
    }
  }
  return std::nullopt;
}

int DdsTeamLink::matched_writers(std::size_t kind) const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(ends_[kind].reader, &status);
  return static_cast<int>(status.current_count);
}

int DdsTeamLink::matched_readers(std::size_t kind) const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(ends_[kind].writer, &status);
  return static_cast<int>(status.current_count);
}

bool DdsTeamLink::waiting(std::size_t kind) const {
  std::uint32_t status = 0;
  dds_get_status_changes(ends_[kind].reader, &status);
  return (status & DDS_DATA_AVAILABLE_STATUS) != 0;
}

DdsAlarms DdsTeamLink::alarms() const {
  constexpr std::size_t heartbeat = emergency_stop - 1;
  dds_requested_deadline_missed_status_t late{};
  dds_liveliness_changed_status_t alive{};
  dds_get_requested_deadline_missed_status(ends_[heartbeat].reader, &late);
  dds_get_liveliness_changed_status(ends_[heartbeat].reader, &alive);
  return {.deadlines_missed = static_cast<long>(late.total_count),
          .writers_lost = static_cast<long>(alive.not_alive_count)};
}

}  // namespace hogline::hw::link
