// A machine of another vendor on the robots' link: it tells what it hears, and orders a shot when the thrower is there.
//   fast_dds_program DOMAIN SKIP_SESSION SKIP_SERIAL
// Lines on stdout: "thrower SESSION PHASE", "board OK STONES X0 Y0 TEAM0", "release SPEED". It runs until it is killed
// or its parent is gone.
#include <unistd.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <thread>

#include "tests/hw/link/fast_dds_values.hpp"

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

namespace {

void on_loopback_alone(DomainParticipantQos& qos) {
  auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  Locator_t here;
  here.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(here, 127, 0, 0, 1);
  qos.wire_protocol().builtin.initialPeersList.push_back(here);
}

// ROS 2's default: reliable, volatile, keep last 10.
template <typename Qos>
Qos ros_default(Qos qos) {
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = VOLATILE_DURABILITY_QOS;
  qos.history().kind = KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  return qos;
}

class Machine {
 public:
  explicit Machine(unsigned domain) {
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    qos.name("another machine");
    on_loopback_alone(qos);
    participant_ = DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    if (participant_ == nullptr) {
      std::fprintf(stderr, "no participant\n");
      std::exit(1);
    }
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }
  ~Machine() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  template <typename Message>
  DataReader* reader(const std::string& topic, const std::string& type) {
    return subscriber_->create_datareader(made<Message>(topic, type), ros_default(DATAREADER_QOS_DEFAULT));
  }
  template <typename Message>
  DataWriter* writer(const std::string& topic, const std::string& type) {
    return publisher_->create_datawriter(made<Message>(topic, type), ros_default(DATAWRITER_QOS_DEFAULT));
  }

 private:
  template <typename Message>
  Topic* made(const std::string& topic, const std::string& type) {
    TypeSupport support(new peer::RosType<Message>("hogline_msgs/" + type));
    support.register_type(participant_);
    return participant_->create_topic("rt/hogline/" + topic, support.get_type_name(), TOPIC_QOS_DEFAULT);
  }

  DomainParticipant* participant_ = nullptr;
  Publisher* publisher_ = nullptr;
  Subscriber* subscriber_ = nullptr;
};

template <typename Message, typename Tell>
void take(DataReader* reader, Tell tell) {
  Message message;
  SampleInfo info;
  while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK)
    if (info.valid_data) tell(message);
}

peer::ShotOrder order_of(const char* const* arguments, std::uint64_t thrower_session) {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  peer::ShotOrder order;
  order.header.sec = static_cast<std::int32_t>(since_1970 / std::chrono::seconds{1});
  order.header.nanosec = static_cast<std::uint32_t>(since_1970 % std::chrono::seconds{1} / std::chrono::nanoseconds{1});
  order.header.frame_id = "e";
  order.origin = {"skip", std::strtoull(arguments[2], nullptr, 10), std::strtoull(arguments[3], nullptr, 10)};
  order.thrower_session = thrower_session;
  order.shot = 5;
  order.speed_mps = 2.125;
  order.heading_rad = -0.0125;
  order.spin_radps = 1.5;
  return order;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Machine machine(static_cast<unsigned>(std::strtoul(arguments[1], nullptr, 10)));
  DataReader* states = machine.reader<peer::ThrowerState>("thrower_state", "ThrowerState");
  DataReader* boards = machine.reader<peer::Board>("board", "Board");
  DataReader* releases = machine.reader<peer::Release>("release", "Release");
  DataWriter* orders = machine.writer<peer::ShotOrder>("shot_order", "ShotOrder");
  bool ordered = false;
  for (const pid_t parent = getppid(); getppid() == parent; std::this_thread::sleep_for(std::chrono::milliseconds{5})) {
    take<peer::ThrowerState>(states, [&](const peer::ThrowerState& m) {
      std::printf("thrower %llu %u\n", static_cast<unsigned long long>(m.origin.session), m.phase);
      PublicationMatchedStatus matched;
      orders->get_publication_matched_status(matched);
      if (ordered || matched.current_count == 0) return;
      peer::ShotOrder order = order_of(arguments, m.origin.session);
      ordered = orders->write(&order);
      std::printf("ordered\n");
    });
    take<peer::Board>(boards, [&](const peer::Board& m) {
      const peer::Stone first = m.stones.empty() ? peer::Stone{} : m.stones[0];
      std::printf("board %d %zu %.3f %.3f %s\n", m.ok, m.stones.size(), first.x, first.y, first.team.c_str());
    });
    take<peer::Release>(releases, [&](const peer::Release& m) { std::printf("release %.4f\n", m.speed_mps); });
  }
  return 0;
}
