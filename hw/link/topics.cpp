#include "hw/link/topics.hpp"

#include "hw/link/wire_messages.hpp"

namespace hogline::hw::link {
namespace {

template <typename Wire>
std::optional<TeamMessage> decode(const void* sample) {
  return plain(*static_cast<const Wire*>(sample));
}

enum class Quality { event, sensor, latched, heartbeat };

template <typename Wire>
Topic topic(std::string_view name, const dds_topic_descriptor_t& type, Quality quality) {
  return {.name = name,
          .type = &type,
          .reliable = quality != Quality::sensor,
          .for_late_joiners = quality == Quality::latched,
          .depth = quality == Quality::sensor ? 5 : (quality == Quality::latched ? 1 : 10),
          .heartbeat = quality == Quality::heartbeat,
          .decode = decode<Wire>};
}

}  // namespace

const std::array<Topic, std::variant_size_v<TeamMessage>>& topics() {
  static const std::array<Topic, std::variant_size_v<TeamMessage>> table{
      topic<hogline_msgs_msg_dds__ShotOrder_>("rt/hogline/shot_order", hogline_msgs_msg_dds__ShotOrder__desc,
                                              Quality::event),
      topic<hogline_msgs_msg_dds__ThrowerState_>("rt/hogline/thrower_state", hogline_msgs_msg_dds__ThrowerState__desc,
                                                 Quality::event),
      topic<hogline_msgs_msg_dds__Release_>("rt/hogline/release", hogline_msgs_msg_dds__Release__desc, Quality::event),
      topic<hogline_msgs_msg_dds__Board_>("rt/hogline/board", hogline_msgs_msg_dds__Board__desc, Quality::event),
      topic<hogline_msgs_msg_dds__StoneTrack_>("rt/hogline/stone_track", hogline_msgs_msg_dds__StoneTrack__desc,
                                               Quality::sensor),
      topic<hogline_msgs_msg_dds__Outcome_>("rt/hogline/outcome", hogline_msgs_msg_dds__Outcome__desc, Quality::event),
      topic<hogline_msgs_msg_dds__Heartbeat_>("rt/hogline/heartbeat", hogline_msgs_msg_dds__Heartbeat__desc,
                                              Quality::heartbeat),
      topic<hogline_msgs_msg_dds__EmergencyStop_>("rt/hogline/emergency_stop",
                                                  hogline_msgs_msg_dds__EmergencyStop__desc, Quality::latched),
  };
  return table;
}

}  // namespace hogline::hw::link
