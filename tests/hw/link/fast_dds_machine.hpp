// A participant of eProsima Fast DDS on the loopback interface alone, with ROS 2's default QoS.
#pragma once

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <memory>
#include <string>

#include "tests/hw/link/fast_dds_values.hpp"

namespace peer {

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

inline void on_loopback_alone(DomainParticipantQos& qos) {
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
  /// One that promises what the robots ask of heartbeats: a deadline of 300 ms and a lease of 800 ms.
  template <typename Message>
  DataWriter* punctual_writer(const std::string& topic, const std::string& type) {
    constexpr std::uint32_t ms = 1000000;
    DataWriterQos qos = ros_default(DATAWRITER_QOS_DEFAULT);
    qos.deadline().period = {0, 300 * ms};
    qos.liveliness().kind = AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = {0, 800 * ms};
    qos.liveliness().announcement_period = {0, 200 * ms};
    return publisher_->create_datawriter(made<Message>(topic, type), qos);
  }
  template <typename Message>
  DataWriter* writer(const std::string& topic, const std::string& type) {
    return publisher_->create_datawriter(made<Message>(topic, type), ros_default(DATAWRITER_QOS_DEFAULT));
  }

 private:
  template <typename Message>
  Topic* made(const std::string& topic, const std::string& type) {
    if (auto* known = dynamic_cast<Topic*>(participant_->lookup_topicdescription("rt/hogline/" + topic))) return known;
    TypeSupport support(new RosType<Message>("hogline_msgs/" + type));
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

}  // namespace peer
