// A CAN bus between programs where the kernel has none: each frame is a multicast datagram, as python-can's
// udp_multicast bus sends and takes them. For simulations: no arbitration, no acknowledgement, no bus-off.
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <string>

#include "hw/can_bus.hpp"
#include "hw/device_status.hpp"
#include "hw/udp_can/udp_can_config.hpp"

namespace hogline::hw {

struct UdpCanCounters {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;
  std::uint64_t malformed = 0;  ///< datagrams that are no classic CAN frame
  std::uint64_t refused = 0;    ///< frames that the network did not take
};

/// Used by one thread. Nothing blocks. Frames are stamped with the kernel's time of their arrival; what was sent here
/// does not come back.
class UdpCanBus final : public CanBus {
 public:
  /// Tries to open at once; step() tries again.
  UdpCanBus(UdpCanConfig config, Stamp now);
  ~UdpCanBus() override;
  UdpCanBus(const UdpCanBus&) = delete;
  UdpCanBus& operator=(const UdpCanBus&) = delete;

  void step(Stamp now);
  CanSendResult send(const CanFrame& frame) override;
  std::optional<StampedCanFrame> receive() override;
  bool up() const override { return in_ >= 0; }

  /// What can be waited on with poll() for a frame; -1 while there is none.
  int descriptor() const { return in_; }
  /// Why it is not open, or nothing.
  std::optional<DeviceError> error() const;
  const UdpCanCounters& counters() const { return counters_; }

 private:
  void open(Stamp now);
  void close();
  bool set_up(int in, int out);

  UdpCanConfig config_;
  sockaddr_in group_{};
  int in_ = -1;
  int out_ = -1;
  std::uint16_t own_port_ = 0;  ///< of `out_`, in network order: by it we know what is ours
  std::string problem_;
  Stamp since_{};
  Stamp next_open_{};
  UdpCanCounters counters_;
};

}  // namespace hogline::hw
