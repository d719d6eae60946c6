#include "hw/sim/canopen_device.hpp"

#include <algorithm>

namespace hogline::hw::sim {
namespace {

constexpr std::uint32_t invalid_pdo = 0x80000000u;

std::uint16_t at(int base, int i) { return static_cast<std::uint16_t>(base + i); }

struct MappingEntry {
  std::uint16_t index;
  std::uint8_t sub;
  int bytes;
};

MappingEntry split(std::uint32_t entry) {
  return {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>((entry >> 8) & 0xFF),
          static_cast<int>(entry & 0xFF) / 8};
}

}  // namespace

CanopenDevice::CanopenDevice(CanBus& bus, const DeviceIdentity& identity, Application& application)
    : bus_(bus),
      application_(application),
      node_(identity.node),
      boot_time_(identity.boot_time),
      sdo_(identity.node, objects_) {
  add_communication_objects(identity);
  for (int i = 0; i < pdo_count; ++i) {
    add_pdo_objects(i, true);
    add_pdo_objects(i, false);
  }
}

// ---- object dictionary ----

void CanopenDevice::add_communication_objects(const DeviceIdentity& identity) {
  objects_.add(0x1000, 0, 4, ObjectAccess::constant, identity.device_type);
  objects_.add(0x1001, 0, 1, ObjectAccess::read_only, 0, true);
  objects_.add(0x1003, 0, 1, ObjectAccess::read_only, 0);
  objects_.add(0x1003, 1, 4, ObjectAccess::read_only, 0);
  objects_.add(0x1005, 0, 4, ObjectAccess::constant, 0x80);
  objects_.add_string(0x1008, 0, identity.name);
  objects_.add(0x1016, 0, 1, ObjectAccess::constant, 1);
  objects_.add(0x1016, 1, 4, ObjectAccess::read_write, 0);
  objects_.add(0x1017, 0, 2, ObjectAccess::read_write, 0);
  objects_.add(0x1018, 0, 1, ObjectAccess::constant, 4);
  objects_.add(0x1018, 1, 4, ObjectAccess::constant, identity.vendor_id);
  objects_.add(0x1018, 2, 4, ObjectAccess::constant, identity.product_code);
  objects_.add(0x1018, 3, 4, ObjectAccess::constant, identity.revision);
  objects_.add(0x1018, 4, 4, ObjectAccess::constant, identity.serial);
}

void CanopenDevice::add_pdo_objects(int number, bool receive) {
  const std::uint16_t communication = at(receive ? 0x1400 : 0x1800, number);
  const std::uint16_t mapping = at(receive ? 0x1600 : 0x1A00, number);
  const std::uint32_t base = (receive ? 0x200u : 0x180u) + 0x100u * static_cast<std::uint32_t>(number);
  const std::uint32_t cob_id = base + node_;

  objects_.add(communication, 0, 1, ObjectAccess::constant, 5);
  // The first PDO of each direction is on by default with 6040 or 6041, as CiA 402 has it; the others are off.
  objects_.add(communication, 1, 4, ObjectAccess::read_write, number == 0 ? cob_id : (cob_id | invalid_pdo)).guard =
      [this, communication](std::int64_t value) { return guard_cob_id(communication, value); };
  objects_.add(communication, 2, 1, ObjectAccess::read_write, 255);
  objects_.add(communication, 5, 2, ObjectAccess::read_write, 0);

  objects_.add(mapping, 0, 1, ObjectAccess::read_write, number == 0 ? 1 : 0).guard =
      [this, mapping, communication](std::int64_t count) { return guard_mapping_count(mapping, communication, count); };
  for (std::uint8_t sub = 1; sub <= 8; ++sub) {
    const std::int64_t entry = number == 0 && sub == 1 ? (receive ? 0x60400010 : 0x60410010) : 0;
    objects_.add(mapping, sub, 4, ObjectAccess::read_write, entry).guard = [this, mapping,
                                                                            communication](std::int64_t value) {
      return guard_mapping_entry(mapping, communication, value);
    };
  }
}

std::uint32_t CanopenDevice::guard_cob_id(std::uint16_t index, std::int64_t value) const {
  // Bits 0..29 may not change while the PDO is and stays valid (CiA 301, 7.5.2.35).
  const std::uint32_t old = objects_.get(index, 1);
  const auto wanted = static_cast<std::uint32_t>(value);
  const bool stays_valid = (old & invalid_pdo) == 0 && (wanted & invalid_pdo) == 0;
  return stays_valid && ((old ^ wanted) & 0x3FFFFFFFu) != 0 ? 0x06090030 : 0;
}

std::uint32_t CanopenDevice::guard_mapping_count(std::uint16_t mapping, std::uint16_t communication,
                                                 std::int64_t count) const {
  if ((objects_.get(communication, 1) & invalid_pdo) == 0) return 0x06010000;
  if (count < 0 || count > 8) return 0x06090030;
  int bytes = 0;
  for (int sub = 1; sub <= count; ++sub) {
    const MappingEntry entry = split(objects_.get(mapping, static_cast<std::uint8_t>(sub)));
    if (!objects_.find(entry.index, entry.sub)) return 0x06020000;
    bytes += entry.bytes;
  }
  return bytes > 8 ? 0x06040042 : 0;
}

std::uint32_t CanopenDevice::guard_mapping_entry(std::uint16_t mapping, std::uint16_t communication,
                                                 std::int64_t value) const {
  const bool valid = (objects_.get(communication, 1) & invalid_pdo) == 0;
  if (valid || objects_.get(mapping, 0) != 0) return 0x06010000;
  const MappingEntry entry = split(static_cast<std::uint32_t>(value));
  const ObjectEntry* object = objects_.find(entry.index, entry.sub);
  if (!object) return 0x06020000;
  const bool receive = communication < 0x1800;
  const bool right_way = !receive || object->access == ObjectAccess::read_write;
  if (!object->mappable || !right_way) return 0x06040041;
  return object->bytes.size() == static_cast<std::size_t>(entry.bytes) ? 0 : 0x06040041;
}

int CanopenDevice::mapped_bytes(std::uint16_t mapping) const {
  int bytes = 0;
  const int count = static_cast<int>(objects_.get(mapping, 0));
  for (int sub = 1; sub <= count; ++sub) bytes += split(objects_.get(mapping, static_cast<std::uint8_t>(sub))).bytes;
  return bytes;
}

// ---- power and NMT ----

void CanopenDevice::set_power(bool on) {
  powered_ = on;
  if (!on) return;
  objects_.restore_defaults(0x1000, 0xFFFF);
  start_booting();
  application_.on_reset();
}

void CanopenDevice::start_booting() {
  nmt_ = Nmt::booting;
  boot_at_.reset();
  last_heartbeat_.reset();
  master_seen_.reset();
  receive_ = {};
  transmit_ = {};
  sdo_.reset();
}

void CanopenDevice::finish_booting(Stamp now) {
  if (faults.never_boots) return;
  if (!boot_at_) boot_at_ = now + boot_time_;
  if (now < *boot_at_) return;
  nmt_ = Nmt::pre_operational;
  bus_.send({.id = 0x700u + node_, .length = 1, .data = {0x00}});
}

void CanopenDevice::on_nmt(const CanFrame& frame) {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != node_)) return;
  switch (frame.data[0]) {
    case 0x01:
      nmt_ = Nmt::operational;
      return;
    case 0x02:
      nmt_ = Nmt::stopped;
      application_.on_communication_lost();
      return;
    case 0x80:
      nmt_ = Nmt::pre_operational;
      return;
    case 0x81:
      objects_.restore_defaults(0x1000, 0xFFFF);
      start_booting();
      application_.on_reset();
      return;
    case 0x82:
      application_.on_communication_lost();
      objects_.restore_defaults(0x1000, 0x1FFF);
      start_booting();
      return;
    default:
      return;
  }
}

// ---- one step ----

void CanopenDevice::step(Stamp now) {
  if (powered_ && nmt_ == Nmt::booting) finish_booting(now);
  while (const std::optional<StampedCanFrame> received = bus_.receive()) {
    const CanFrame& frame = received->frame;
    if (powered_ && nmt_ != Nmt::booting && !frame.extended && !frame.remote) on_frame(frame, now);
  }
  if (!powered_ || nmt_ == Nmt::booting) return;
  serve_heartbeat(now);
  watch_master(now);
  watch_receive_pdos(now);
  serve_event_pdos(now);
}

void CanopenDevice::on_frame(const CanFrame& frame, Stamp now) {
  if (frame.id == 0x000) return on_nmt(frame);
  if (frame.id == 0x080 && nmt_ == Nmt::operational) return on_sync(now);
  if (frame.id > 0x700 && frame.id <= 0x77F) return on_heartbeat(static_cast<std::uint8_t>(frame.id - 0x700), now);
  if (frame.id == 0x600u + node_) return on_sdo(frame);
  if (nmt_ != Nmt::operational) return;
  for (int i = 0; i < pdo_count; ++i) {
    const std::uint32_t cob_id = objects_.get(at(0x1400, i), 1);
    if ((cob_id & invalid_pdo) == 0 && (cob_id & 0x7FF) == frame.id) on_receive_pdo(i, frame, now);
  }
}

void CanopenDevice::on_sdo(const CanFrame& frame) {
  if (nmt_ == Nmt::stopped || faults.sdo_silent) return;
  const std::uint32_t object = (frame.data[1] | (std::uint32_t{frame.data[2]} << 8)) << 8 | frame.data[3];
  const bool download = (frame.data[0] >> 5) == 1;
  if (download && faults.sdo_ignores != 0 && object == faults.sdo_ignores) {
    bus_.send({.id = 0x580u + node_, .length = 8, .data = {0x60, frame.data[1], frame.data[2], frame.data[3]}});
    return;
  }
  std::optional<CanFrame> response = sdo_.on_request(frame);
  if (!response) return;
  const bool segment = (response->data[0] >> 5) == 0;
  if (segment && faults.sdo_toggle_stuck) response->data[0] &= 0xEF;
  if (!segment && faults.sdo_wrong_echo) response->data[3] ^= 1;
  bus_.send(*response);
}

// ---- PDOs ----

void CanopenDevice::on_receive_pdo(int i, const CanFrame& frame, Stamp now) {
  const int expected = mapped_bytes(at(0x1600, i));
  if (frame.length < expected) return emergency(0x8210, 0x10);
  if (frame.length > expected) emergency(0x8220, 0x10);
  ReceivePdo& pdo = receive_[static_cast<std::size_t>(i)];
  pdo.last = now;
  if (objects_.get(at(0x1400, i), 2) <= 240) {
    pdo.buffered = frame;
  } else {
    apply_receive_pdo(i, frame);
  }
}

void CanopenDevice::apply_receive_pdo(int i, const CanFrame& frame) {
  std::size_t offset = 0;
  const int count = static_cast<int>(objects_.get(at(0x1600, i), 0));
  for (int sub = 1; sub <= count; ++sub) {
    const MappingEntry entry = split(objects_.get(at(0x1600, i), static_cast<std::uint8_t>(sub)));
    const auto size = static_cast<std::size_t>(entry.bytes);
    objects_.write(entry.index, entry.sub, std::span{frame.data}.subspan(offset, size));
    offset += size;
  }
}

void CanopenDevice::on_sync(Stamp now) {
  for (int i = 0; i < pdo_count; ++i) {
    ReceivePdo& receive = receive_[static_cast<std::size_t>(i)];
    if (receive.buffered) apply_receive_pdo(i, *receive.buffered);
    receive.buffered.reset();
  }
  for (int i = 0; i < pdo_count; ++i) {
    const std::uint32_t type = objects_.get(at(0x1800, i), 2);
    if (type < 1 || type > 240) continue;
    TransmitPdo& transmit = transmit_[static_cast<std::size_t>(i)];
    if (++transmit.syncs < static_cast<int>(type)) continue;
    transmit.syncs = 0;
    send_transmit_pdo(i, now);
  }
}

std::vector<std::uint8_t> CanopenDevice::transmit_contents(int i) const {
  std::vector<std::uint8_t> contents;
  const int count = static_cast<int>(objects_.get(at(0x1A00, i), 0));
  for (int sub = 1; sub <= count; ++sub) {
    const MappingEntry entry = split(objects_.get(at(0x1A00, i), static_cast<std::uint8_t>(sub)));
    const ObjectEntry* object = objects_.find(entry.index, entry.sub);
    contents.insert(contents.end(), object->bytes.begin(), object->bytes.end());
  }
  return contents;
}

void CanopenDevice::send_transmit_pdo(int i, Stamp now) {
  const std::uint32_t cob_id = objects_.get(at(0x1800, i), 1);
  if ((cob_id & invalid_pdo) != 0 || faults.tpdos_stopped) return;
  TransmitPdo& pdo = transmit_[static_cast<std::size_t>(i)];
  if (!faults.tpdos_frozen || pdo.sent.empty()) pdo.sent = transmit_contents(i);
  pdo.last = now;

  CanFrame frame{.id = cob_id & 0x7FF, .length = static_cast<std::uint8_t>(pdo.sent.size()), .data = {}};
  std::copy(pdo.sent.begin(), pdo.sent.end(), frame.data.begin());
  if (faults.tpdos_short && frame.length > 0) --frame.length;
  bus_.send(frame);
}

void CanopenDevice::serve_event_pdos(Stamp now) {
  if (nmt_ != Nmt::operational) return;
  for (int i = 0; i < pdo_count; ++i) {
    if (objects_.get(at(0x1800, i), 2) < 254) continue;
    const TransmitPdo& pdo = transmit_[static_cast<std::size_t>(i)];
    const std::chrono::milliseconds timer{objects_.get(at(0x1800, i), 5)};
    const bool due = timer.count() > 0 && now - pdo.last >= timer;
    if (due || transmit_contents(i) != pdo.sent) send_transmit_pdo(i, now);
  }
}

void CanopenDevice::watch_receive_pdos(Stamp now) {
  if (nmt_ != Nmt::operational) return;
  for (int i = 0; i < pdo_count; ++i) {
    ReceivePdo& pdo = receive_[static_cast<std::size_t>(i)];
    const std::chrono::milliseconds timer{objects_.get(at(0x1400, i), 5)};
    if (timer.count() == 0 || !pdo.last || now - *pdo.last < timer) continue;
    pdo.last.reset();  // armed again by the next reception
    emergency(0x8250, 0x10);
    application_.on_communication_lost();
  }
}

// ---- heartbeat and EMCY ----

void CanopenDevice::serve_heartbeat(Stamp now) {
  const std::chrono::milliseconds period{objects_.get(0x1017)};
  if (period.count() == 0) return;
  if (last_heartbeat_ && now - *last_heartbeat_ < period) return;
  last_heartbeat_ = now;
  const std::uint8_t state = nmt_ == Nmt::operational ? 0x05 : nmt_ == Nmt::stopped ? 0x04 : 0x7F;
  if (!faults.heartbeat_stopped) bus_.send({.id = 0x700u + node_, .length = 1, .data = {state}});
}

void CanopenDevice::on_heartbeat(std::uint8_t node, Stamp now) {
  if (((objects_.get(0x1016, 1) >> 16) & 0x7F) == node) master_seen_ = now;
}

void CanopenDevice::watch_master(Stamp now) {
  const std::chrono::milliseconds timeout{objects_.get(0x1016, 1) & 0xFFFF};
  if (timeout.count() == 0 || !master_seen_ || now - *master_seen_ < timeout) return;
  master_seen_.reset();  // monitored again from its next heartbeat
  emergency(0x8130, 0x10);
  if (nmt_ == Nmt::operational) nmt_ = Nmt::pre_operational;  // 1029:01 = 0, the default
  application_.on_communication_lost();
}

void CanopenDevice::emergency(std::uint16_t code, std::uint8_t error_register) {
  if (!powered_ || nmt_ == Nmt::booting) return;
  const auto now_register = static_cast<std::uint8_t>(code == 0 ? 0 : objects_.get(0x1001) | error_register | 0x01);
  objects_.set(0x1001, 0, now_register);
  if (code != 0) {
    objects_.set(0x1003, 0, 1);
    objects_.set(0x1003, 1, code);
  }
  if (nmt_ == Nmt::stopped) return;
  bus_.send({.id = 0x080u + node_,
             .length = 8,
             .data = {static_cast<std::uint8_t>(code & 0xFF), static_cast<std::uint8_t>(code >> 8), now_register}});
}

}  // namespace hogline::hw::sim
