// ROS 2 messages for eProsima Fast DDS, written out from their definitions: what an independent machine makes of the
// names on the wire. Nothing here comes from hogline's IDL.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>
#include <vector>

namespace peer {

struct Header {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;
};

struct Origin {
  std::string robot;
  std::uint64_t session = 0;
  std::uint64_t serial = 0;
};

struct ShotOrder {
  Header header;
  Origin origin;
  std::uint64_t thrower_session = 0;
  std::uint32_t shot = 0;
  double speed_mps = 0.0;
  double heading_rad = 0.0;
  double spin_radps = 0.0;
};

struct ThrowerState {
  Header header;
  Origin origin;
  std::uint8_t phase = 0;
  bool armed = false;
  std::uint64_t order_serial = 0;
  std::string reason;
};

struct Stone {
  double x = 0.0, y = 0.0, z = 0.0;
  std::array<double, 3> covariance{};
  std::string team;
};

struct Board {
  Header header;
  Origin origin;
  bool ok = false;
  std::string reason;
  std::vector<Stone> stones;
};

struct Release {
  Header header;
  Origin origin;
  std::uint64_t order_serial = 0;
  double hog_distance_m = 0.0, lateral_m = 0.0, speed_mps = 0.0, heading_rad = 0.0, spin_radps = 0.0;
};

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

struct Echo {
  std::string robot;
  std::uint64_t session = 0;
  Time sent;
  Time heard;
};

struct Heartbeat {
  Header header;
  Origin origin;
  std::vector<Echo> echoes;
};

using Cdr = eprosima::fastcdr::Cdr;

inline void pass(Cdr& c, Header& h, bool out) {
  if (out)
    c << h.sec << h.nanosec << h.frame_id;
  else
    c >> h.sec >> h.nanosec >> h.frame_id;
}
inline void pass(Cdr& c, Origin& o, bool out) {
  if (out)
    c << o.robot << o.session << o.serial;
  else
    c >> o.robot >> o.session >> o.serial;
}
inline void pass(Cdr& c, ShotOrder& m, bool out) {
  pass(c, m.header, out);
  pass(c, m.origin, out);
  if (out)
    c << m.thrower_session << m.shot << m.speed_mps << m.heading_rad << m.spin_radps;
  else
    c >> m.thrower_session >> m.shot >> m.speed_mps >> m.heading_rad >> m.spin_radps;
}
inline void pass(Cdr& c, ThrowerState& m, bool out) {
  pass(c, m.header, out);
  pass(c, m.origin, out);
  if (out)
    c << m.phase << m.armed << m.order_serial << m.reason;
  else
    c >> m.phase >> m.armed >> m.order_serial >> m.reason;
}
inline void pass(Cdr& c, Release& m, bool out) {
  pass(c, m.header, out);
  pass(c, m.origin, out);
  if (out)
    c << m.order_serial << m.hog_distance_m << m.lateral_m << m.speed_mps << m.heading_rad << m.spin_radps;
  else
    c >> m.order_serial >> m.hog_distance_m >> m.lateral_m >> m.speed_mps >> m.heading_rad >> m.spin_radps;
}
inline void pass(Cdr& c, Stone& s, bool out) {
  if (out)
    c << s.x << s.y << s.z << s.covariance[0] << s.covariance[1] << s.covariance[2] << s.team;
  else
    c >> s.x >> s.y >> s.z >> s.covariance[0] >> s.covariance[1] >> s.covariance[2] >> s.team;
}
inline void pass(Cdr& c, Board& m, bool out) {
  pass(c, m.header, out);
  pass(c, m.origin, out);
  if (out)
    c << m.ok << m.reason;
  else
    c >> m.ok >> m.reason;
  auto count = static_cast<std::uint32_t>(m.stones.size());
  if (out)
    c << count;
  else {
    c >> count;
    m.stones.resize(std::min<std::uint32_t>(count, 1000));
  }
  for (Stone& s : m.stones) pass(c, s, out);
}

inline void pass(Cdr& c, Time& t, bool out) {
  if (out)
    c << t.sec << t.nanosec;
  else
    c >> t.sec >> t.nanosec;
}
inline void pass(Cdr& c, Echo& e, bool out) {
  if (out)
    c << e.robot << e.session;
  else
    c >> e.robot >> e.session;
  pass(c, e.sent, out);
  pass(c, e.heard, out);
}
inline void pass(Cdr& c, Heartbeat& m, bool out) {
  pass(c, m.header, out);
  pass(c, m.origin, out);
  auto count = static_cast<std::uint32_t>(m.echoes.size());
  if (out)
    c << count;
  else {
    c >> count;
    m.echoes.resize(std::min<std::uint32_t>(count, 1000));
  }
  for (Echo& e : m.echoes) pass(c, e, out);
}

/// A type by its ROS 2 name, final, without keys, plain CDR in this machine's byte order.
template <typename Message>
class RosType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RosType(const std::string& package_and_name) {
    const auto slash = package_and_name.find('/');
    setName((package_and_name.substr(0, slash) + "::msg::dds_::" + package_and_name.substr(slash + 1) + "_").c_str());
    m_typeSize = 65536;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
    cdr.serialize_encapsulation();
    pass(cdr, *static_cast<Message*>(data), true);
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    pass(cdr, *static_cast<Message*>(data), false);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [this] { return m_typeSize; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace peer
