// The communication half of a simulated CANopen device, from CiA 301: NMT, heartbeat both ways, SYNC, PDOs, EMCY, SDO.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hw/can_bus.hpp"
#include "hw/sim/object_dictionary.hpp"
#include "hw/sim/sdo_server.hpp"

namespace hogline::hw::sim {

struct DeviceIdentity {
  std::uint8_t node = 0;
  std::uint32_t device_type = 0;  ///< 1000
  std::uint32_t vendor_id = 0;    ///< 1018:01 ...
  std::uint32_t product_code = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
  std::string name;                                    ///< 1008
  Duration boot_time = std::chrono::milliseconds{20};  ///< from power or reset to the boot-up message
};

/// What a test can break in the communication. All may change at any time.
struct DeviceFaults {
  bool heartbeat_stopped = false;  ///< everything else goes on
  bool tpdos_stopped = false;      ///< no TPDO leaves
  bool tpdos_frozen = false;       ///< TPDOs leave on time, with the contents they had
  bool tpdos_short = false;        ///< TPDOs leave one byte too short
  bool sdo_silent = false;         ///< SDO requests are not answered
  bool sdo_toggle_stuck = false;   ///< segments are answered without alternating the toggle bit
  bool sdo_wrong_echo = false;     ///< answers name another object
  std::uint32_t sdo_ignores = 0;   ///< writes to this object (index << 8 | sub) are confirmed and forgotten
  bool never_boots = false;        ///< from the next reset on it stays silent
};

class CanopenDevice {
 public:
  enum class Nmt { booting, pre_operational, operational, stopped };

  /// What the device does beyond communicating.
  class Application {
   public:
    virtual ~Application() = default;
    /// Power-up or NMT reset node: the objects have their default values again.
    virtual void on_reset() = 0;
    /// Heartbeat or RPDO timeout, NMT stop or a reset: object 6007 says what a drive does then.
    virtual void on_communication_lost() = 0;
  };

  CanopenDevice(CanBus& bus, const DeviceIdentity& identity, Application& application);

  /// Reads all that arrived, answers, and serves the timers.
  void step(Stamp now);
  /// Sends EMCY and keeps code and register in 1003 and 1001. Code 0: all errors are gone.
  void emergency(std::uint16_t code, std::uint8_t error_register);
  /// Switches the supply: off is silent for ever, on boots.
  void set_power(bool on);

  ObjectDictionary& objects() { return objects_; }
  const ObjectDictionary& objects() const { return objects_; }
  Nmt nmt() const { return nmt_; }
  bool powered() const { return powered_; }

  DeviceFaults faults;

 private:
  static constexpr int pdo_count = 4;

  struct ReceivePdo {
    std::optional<CanFrame> buffered;  ///< until the next SYNC
    std::optional<Stamp> last;         ///< the event timer runs from the first reception
  };
  struct TransmitPdo {
    std::vector<std::uint8_t> sent;
    int syncs = 0;
    Stamp last{};
  };

  void add_communication_objects(const DeviceIdentity& identity);
  void add_pdo_objects(int number, bool receive);
  std::uint32_t guard_cob_id(std::uint16_t index, std::int64_t value) const;
  std::uint32_t guard_mapping_count(std::uint16_t mapping, std::uint16_t communication, std::int64_t count) const;
  std::uint32_t guard_mapping_entry(std::uint16_t mapping, std::uint16_t communication, std::int64_t entry) const;

  void start_booting();
  void finish_booting(Stamp now);
  void on_frame(const CanFrame& frame, Stamp now);
  void on_nmt(const CanFrame& frame);
  void on_sdo(const CanFrame& frame);
  void on_sync(Stamp now);
  void on_heartbeat(std::uint8_t node, Stamp now);
  void on_receive_pdo(int i, const CanFrame& frame, Stamp now);
  void apply_receive_pdo(int i, const CanFrame& frame);
  void send_transmit_pdo(int i, Stamp now);
  std::vector<std::uint8_t> transmit_contents(int i) const;
  void serve_heartbeat(Stamp now);
  void watch_master(Stamp now);
  void watch_receive_pdos(Stamp now);
  void serve_event_pdos(Stamp now);
  int mapped_bytes(std::uint16_t mapping) const;

  CanBus& bus_;
  Application& application_;
  std::uint8_t node_;
  Duration boot_time_;
  ObjectDictionary objects_;
  SdoServer sdo_;

  bool powered_ = true;
  Nmt nmt_ = Nmt::booting;
  std::optional<Stamp> boot_at_;
  std::optional<Stamp> last_heartbeat_;
  std::optional<Stamp> master_seen_;
  std::array<ReceivePdo, pdo_count> receive_{};
  std::array<TransmitPdo, pdo_count> transmit_{};
};

}  // namespace hogline::hw::sim
