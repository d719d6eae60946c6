#!/usr/bin/env python3
"""A foreign node on the CAN bus between programs: python-can's own udp_multicast bus.

udp_can_echo.py GROUP PORT: says "ready", sends each frame that it hears back with its identifier one higher, and ends
with its stdin. python-can joins on the machine's default interface; the tests' bus is on lo, so the same socket is
given lo as well.
"""
import select
import socket
import struct
import sys

import can


def on_loopback(bus, group):
    index = socket.if_nametoindex("lo")
    membership = socket.inet_aton(group) + socket.inet_aton("0.0.0.0") + struct.pack("@i", index)
    line = bus._multicast._socket
    for option in (socket.IP_ADD_MEMBERSHIP, socket.IP_MULTICAST_IF):
        line.setsockopt(socket.IPPROTO_IP, option, membership)


def main():
    group, port = sys.argv[1], int(sys.argv[2])
    bus = can.Bus(interface="udp_multicast", channel=group, port=port, hop_limit=0)
    on_loopback(bus, group)
    sent = set()
    print("ready", flush=True)
    while True:
        ready, _, _ = select.select([bus.fileno(), sys.stdin], [], [])
        if sys.stdin in ready:
            return
        message = bus.recv(0)
        if message is None or message.arbitration_id in sent:
            continue
        message.arbitration_id += 1
        sent.add(message.arbitration_id)
        bus.send(message)


if __name__ == "__main__":
    main()
