#!/usr/bin/python3
"""CANopen drive nodes on a SocketCAN interface: a foreign peer for the tests.

Written from CiA 301 (NMT, heartbeat, SDO server, PDO, EMCY) and CiA 402 (state machine, cyclic synchronous velocity) on
python-can; it shares nothing with hogline's own code. The motor is ideal: it turns as fast as it is told, and brakes with
the quick-stop deceleration 6085. Velocity units are position units per second.

    canopen_node.py --channel vcan0 --node 1 [--node 2 ...]
"""
import argparse
import struct
import time

import can

NMT_START, NMT_STOP, NMT_PREOP, NMT_RESET, NMT_RESET_COMMUNICATION = 0x01, 0x02, 0x80, 0x81, 0x82
STOPPED, OPERATIONAL, PRE_OPERATIONAL = 0x04, 0x05, 0x7F

# SDO abort codes (CiA 301, table 22)
TOGGLE, COMMAND, WRITE_ONLY, READ_ONLY = 0x05030000, 0x05040001, 0x06010001, 0x06010002
NO_OBJECT, NOT_MAPPABLE, PDO_LENGTH, LENGTH, NO_SUB, VALUE = 0x06020000, 0x06040041, 0x06040042, 0x06070010, 0x06090011, 0x06090030
DEVICE_STATE = 0x08000022

EMCY_HEARTBEAT, EMCY_RPDO_LENGTH, EMCY_RPDO_TIMEOUT = 0x8130, 0x8210, 0x8250


class Abort(Exception):
    def __init__(self, code):
        super().__init__(f"{code:08X}")
        self.code = code


class Dictionary:
    """Object dictionary: fixed-size little-endian values and strings, each with its access (ro, rw, wo)."""

    def __init__(self):
        self.format, self.access, self.value, self.mappable = {}, {}, {}, set()

    def add(self, index, sub, kind, access, value=0, mappable=False):
        key = (index, sub)
        self.format[key], self.access[key], self.value[key] = kind, access, value
        if mappable:
            self.mappable.add(key)

    def require(self, key):
        if key not in self.value:
            raise Abort(NO_SUB if any(index == key[0] for index, _ in self.value) else NO_OBJECT)

    def size(self, key):
        return struct.calcsize("<" + self.format[key])

    def pack(self, key):
        value = self.value[key]
        return value.encode() if isinstance(value, str) else struct.pack("<" + self.format[key], value)

    def unpack(self, key, data):
        if len(data) != self.size(key):
            raise Abort(LENGTH)
        return struct.unpack("<" + self.format[key], bytes(data))[0]


class Drive:
    """CiA 402: the state machine and an ideal axis."""

    STATUS = {
        "switch_on_disabled": 0x0240, "ready": 0x0221, "switched_on": 0x0223, "enabled": 0x0227,
        "quick_stop": 0x0207, "fault": 0x0208,
    }

    def __init__(self, objects):
        self.objects = objects
        self.state = "switch_on_disabled"
        self.last_control = 0
        self.velocity = self.position = 0.0
        for index, kind, access, mappable in [
            (0x603F, "H", "ro", True), (0x6040, "H", "rw", True), (0x6041, "H", "ro", True), (0x605A, "h", "rw", False),
            (0x605E, "h", "rw", False), (0x6007, "h", "rw", False), (0x6060, "b", "rw", True), (0x6061, "b", "ro", True),
            (0x6064, "i", "ro", True), (0x606C, "i", "ro", True), (0x6085, "I", "rw", False), (0x60FF, "i", "rw", True),
        ]:
            objects.add(index, 0, kind, access, 0, mappable)
        objects.value[(0x6085, 0)] = 10000
        objects.add(0x60C2, 0, "B", "ro", 2)
        objects.add(0x60C2, 1, "B", "rw", 1)
        objects.add(0x60C2, 2, "b", "rw", -3)

    def get(self, index):
        return self.objects.value[(index, 0)]

    def put(self, index, value):
        self.objects.value[(index, 0)] = value

    def control(self, word):
        """A controlword was written. Transitions numbered as in the standard's figure."""
        rising_reset = word & 0x80 and not self.last_control & 0x80
        self.last_control = word
        if self.state == "fault":
            if rising_reset:  # 15
                self.state = "switch_on_disabled"
                self.put(0x603F, 0)
        elif not word & 0x02:  # 7, 9, 10, 12: disable voltage
            self.state = "switch_on_disabled"
        elif not word & 0x04:  # 11 from enabled; 7, 10 from below
            if self.state == "enabled":
                self.state = "quick_stop"
            elif self.state in ("ready", "switched_on"):
                self.state = "switch_on_disabled"
        elif word & 0x0F == 0x06:  # 2, 6, 8
            if self.state in ("switch_on_disabled", "switched_on", "enabled"):
                self.state = "ready"
        elif word & 0x0F == 0x07:  # 3, 5
            if self.state in ("ready", "enabled"):
                self.state = "switched_on"
        elif word & 0x0F == 0x0F:  # 4 (3 and 4 at once from ready)
            if self.state in ("ready", "switched_on"):
                self.state = "enabled"

    def fault(self, code):
        self.put(0x603F, code)
        self.state = "fault"

    def connection_lost(self):
        """6007: 1 fault, 2 disable voltage, 3 quick stop."""
        if self.state == "enabled":
            reaction = self.get(0x6007)
            self.state = {1: "fault", 2: "switch_on_disabled", 3: "quick_stop"}.get(reaction, self.state)

    def step(self, dt):
        if self.state == "enabled" and self.get(0x6061) == 9:
            self.velocity = float(self.get(0x60FF))
        elif self.velocity:
            brake = max(self.get(0x6085), 1) * dt
            self.velocity = max(abs(self.velocity) - brake, 0.0) * (1 if self.velocity > 0 else -1)
        elif self.state == "quick_stop" and self.get(0x605A) not in (5, 6, 7, 8):
            self.state = "switch_on_disabled"  # 12: after the ramp, unless it is to hold
        self.position += self.velocity * dt
        self.put(0x6061, self.get(0x6060) if self.get(0x6060) == 9 else 0)
        self.put(0x606C, int(round(self.velocity)))
        self.put(0x6064, (int(round(self.position)) + 2**31) % 2**32 - 2**31)
        self.put(0x6041, self.STATUS[self.state])


class Node:
    PDOS = 4

    def __init__(self, bus, number):
        self.bus, self.number = bus, number
        self.reset(everything=True)

    # ---- set-up and NMT ----

    def reset(self, everything):
        if everything:
            self.objects = Dictionary()
            self.drive = Drive(self.objects)
        self.add_communication_objects()
        self.upload = self.download = None
        self.heartbeat_due = self.watch_due = None
        self.rpdo_due = [None] * self.PDOS
        self.syncs = 0
        self.state = PRE_OPERATIONAL
        self.send(0x700 + self.number, b"\0")

    def add_communication_objects(self):
        add = self.objects.add
        add(0x1000, 0, "I", "ro", 0x00020192)
        add(0x1001, 0, "B", "ro", 0)
        add(0x1008, 0, "s", "ro", "CURLING DRIVE 1")
        add(0x1016, 0, "B", "ro", 1)
        add(0x1016, 1, "I", "rw", 0)
        add(0x1017, 0, "H", "rw", 0)
        for sub, value in enumerate([4, 0x00000539, 0x00000402, 0x00010001, self.number]):
            add(0x1018, sub, "B" if sub == 0 else "I", "ro", value)
        for pdo in range(self.PDOS):
            for first, cob_id in ((0x1400, 0x200), (0x1800, 0x40000180)):
                add(first + pdo, 0, "B", "ro", 5)
                add(first + pdo, 1, "I", "rw", 0x80000000 | (cob_id + 0x100 * pdo + self.number))
                add(first + pdo, 2, "B", "rw", 255)
                add(first + pdo, 3, "H", "rw", 0)
                add(first + pdo, 5, "H", "rw", 0)
            for first in (0x1600, 0x1A00):
                add(first + pdo, 0, "B", "rw", 0)
                for sub in range(1, 9):
                    add(first + pdo, sub, "I", "rw", 0)

    def nmt(self, command):
        if command in (NMT_RESET, NMT_RESET_COMMUNICATION):
            return self.reset(command == NMT_RESET)
        self.state = {NMT_START: OPERATIONAL, NMT_STOP: STOPPED, NMT_PREOP: PRE_OPERATIONAL}.get(command, self.state)
        return None

    def send(self, cob_id, data):
        try:
            self.bus.send(can.Message(arbitration_id=cob_id, is_extended_id=False, data=data), timeout=0)
        except can.CanError:
            pass  # no room, or the link is down: a node goes on

    def emergency(self, code):
        self.send(0x080 + self.number, struct.pack("<HB5x", code, 0x11))

    # ---- SDO server (CiA 301, 7.2.4.3) ----

    def sdo(self, data):
        if len(data) != 8 or self.state == STOPPED:
            return
        key = struct.unpack("<HB", data[1:4])
        try:
            specifier = data[0] >> 5
            if specifier == 1:
                reply = self.begin_download(key, data)
            elif specifier == 0 and self.download:
                reply = self.download_segment(data)
            elif specifier == 2:
                reply = self.begin_upload(key)
            elif specifier == 3 and self.upload:
                reply = self.upload_segment(data)
            elif specifier == 4:
                self.upload = self.download = None
                return
            else:
                raise Abort(COMMAND)
        except Abort as abort:
            self.upload = self.download = None
            reply = struct.pack("<BHBI", 0x80, *key, abort.code)
        self.send(0x580 + self.number, reply.ljust(8, b"\0"))

    def begin_download(self, key, data):
        self.objects.require(key)
        if self.objects.access[key] == "ro":
            raise Abort(READ_ONLY)
        expedited, sized = data[0] & 2, data[0] & 1
        if expedited:
            size = 4 - (data[0] >> 2 & 3) if sized else self.objects.size(key)
            self.write(key, data[4:4 + size])
        else:
            self.download = {"key": key, "data": b"", "toggle": 0}
        return struct.pack("<BHB", 0x60, *key)

    def download_segment(self, data):
        toggle = data[0] & 0x10
        if toggle != self.download["toggle"]:
            raise Abort(TOGGLE)
        self.download["data"] += bytes(data[1:8 - (data[0] >> 1 & 7)])
        self.download["toggle"] ^= 0x10
        if data[0] & 1:
            self.write(self.download["key"], self.download["data"])
            self.download = None
        return bytes([0x20 | toggle])

    def begin_upload(self, key):
        self.objects.require(key)
        if self.objects.access[key] == "wo":
            raise Abort(WRITE_ONLY)
        data = self.objects.pack(key)
        if len(data) <= 4:
            return struct.pack("<BHB", 0x43 | (4 - len(data)) << 2, *key) + data
        self.upload = {"data": data, "toggle": 0}
        return struct.pack("<BHBI", 0x41, *key, len(data))

    def upload_segment(self, data):
        toggle = data[0] & 0x10
        if toggle != self.upload["toggle"]:
            raise Abort(TOGGLE)
        part, self.upload["data"] = self.upload["data"][:7], self.upload["data"][7:]
        self.upload["toggle"] ^= 0x10
        last = not self.upload["data"]
        if last:
            self.upload = None
        return bytes([toggle | (7 - len(part)) << 1 | last]) + part

    def write(self, key, data):
        value = self.objects.unpack(key, data)
        index, sub = key
        if 0x1600 <= index < 0x1600 + self.PDOS or 0x1A00 <= index < 0x1A00 + self.PDOS:
            self.check_mapping(index, sub, value)
        if index == 0x6060 and value not in (0, 9):
            raise Abort(VALUE)
        self.objects.value[key] = value
        if index == 0x6040:
            self.drive.control(value)
        if index == 0x1016:
            self.watch_due = None  # begins with the first heartbeat
        if index == 0x1017:
            self.heartbeat_due = None

    def check_mapping(self, index, sub, value):
        """A mapping changes only while its PDO is switched off (bit 31) and its count is 0."""
        if not self.objects.value[(index - 0x200, 1)] & 0x80000000:
            raise Abort(DEVICE_STATE)
        if sub == 0:
            if sum(self.objects.value[(index, s)] & 0xFF for s in range(1, value + 1)) > 64:
                raise Abort(PDO_LENGTH)
            return
        if self.objects.value[(index, 0)] != 0:
            raise Abort(DEVICE_STATE)
        key, bits = (value >> 16, value >> 8 & 0xFF), value & 0xFF
        if key not in self.objects.mappable or self.objects.size(key) * 8 != bits:
            raise Abort(NOT_MAPPABLE)

    # ---- PDO ----

    def mapped(self, mapping):
        entries = [self.objects.value[(mapping, sub)] for sub in range(1, self.objects.value[(mapping, 0)] + 1)]
        return [(entry >> 16, entry >> 8 & 0xFF) for entry in entries]

    def rpdo(self, cob_id, data, now):
        for pdo in range(self.PDOS):
            if self.objects.value[(0x1400 + pdo, 1)] != cob_id:  # bit 31 set never matches
                continue
            keys = self.mapped(0x1600 + pdo)
            if len(data) < sum(self.objects.size(key) for key in keys):
                return self.emergency(EMCY_RPDO_LENGTH)
            timer = self.objects.value[(0x1400 + pdo, 5)]
            self.rpdo_due[pdo] = now + timer * 1e-3 if timer else None
            for key in keys:
                size = self.objects.size(key)
                self.objects.value[key] = self.objects.unpack(key, data[:size])
                data = data[size:]
                if key == (0x6040, 0):
                    self.drive.control(self.objects.value[key])
        return None

    def sync(self):
        self.syncs += 1
        for pdo in range(self.PDOS):
            cob_id, kind = self.objects.value[(0x1800 + pdo, 1)], self.objects.value[(0x1800 + pdo, 2)]
            if not cob_id & 0x80000000 and 1 <= kind <= 240 and self.syncs % kind == 0:
                self.send(cob_id & 0x7FF, b"".join(self.objects.pack(key) for key in self.mapped(0x1A00 + pdo)))

    # ---- the node's life ----

    def receive(self, message, now):
        if message.is_extended_id or message.is_remote_frame or message.is_error_frame or message.is_fd:
            return
        cob_id, data = message.arbitration_id, bytes(message.data)
        if cob_id == 0x000 and len(data) == 2 and data[1] in (0, self.number):
            self.nmt(data[0])
        elif cob_id == 0x600 + self.number:
            self.sdo(data)
        elif self.state == OPERATIONAL and cob_id == 0x080:
            self.sync()
        elif self.state == OPERATIONAL and 0x200 <= cob_id < 0x580:
            self.rpdo(cob_id, data, now)
        elif 0x700 <= cob_id < 0x780:
            watched, limit_ms = self.objects.value[(0x1016, 1)] >> 16, self.objects.value[(0x1016, 1)] & 0xFFFF
            if limit_ms and cob_id == 0x700 + watched:
                self.watch_due = now + limit_ms * 1e-3

    def step(self, now, dt):
        self.drive.step(dt)
        period = self.objects.value[(0x1017, 0)] * 1e-3
        if period and (self.heartbeat_due is None or now >= self.heartbeat_due):
            self.send(0x700 + self.number, bytes([self.state]))
            self.heartbeat_due = now + period
        if self.watch_due is not None and now >= self.watch_due:
            self.watch_due = None
            self.emergency(EMCY_HEARTBEAT)
            self.drive.connection_lost()
        for pdo in range(self.PDOS):
            if self.rpdo_due[pdo] is not None and now >= self.rpdo_due[pdo]:
                self.rpdo_due[pdo] = None
                self.emergency(EMCY_RPDO_TIMEOUT)
                self.drive.connection_lost()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--channel", required=True)
    parser.add_argument("--node", type=int, action="append", required=True)
    options = parser.parse_args()

    bus = can.Bus(interface="socketcan", channel=options.channel)
    nodes = [Node(bus, number) for number in options.node]
    last = time.monotonic()
    while True:
        try:
            message = bus.recv(timeout=0.002)
        except can.CanError:  # the link went down: told once, the same socket goes on
            message = None
        now = time.monotonic()
        if message is not None:
            for node in nodes:
                node.receive(message, now)
        if now - last >= 0.002:
            for node in nodes:
                node.step(now, now - last)
            last = now


if __name__ == "__main__":
    main()
