#!/usr/bin/env python3
"""A Robotiq 2F gripper served by pymodbus, over TCP or over a pseudo terminal with RTU.

Written from the maker's register map alone; it shares nothing with the program under test. The map, as the maker
publishes it: holding registers 03E8-03EA take the action request (high byte of 03E8: bit 0 activate, bit 3 go to), the
position (low byte of 03E9) and speed and force (03EA); input registers 07D0-07D2 give the gripper status (high byte of
07D0: bit 0 gACT, bit 3 gGTO, bits 4-5 gSTA, bits 6-7 gOBJ), the fault and the echo of the position asked for, and the
position and the current. Time is counted in status reads, not in seconds: a motion of the fingers lasts `--reads` of
them, so a slow machine sees the same gripper.

Prints "READY PORT" or "READY PATH" when it can be talked to. Then it reads lines from stdin and answers each:
  state    the gripper as one line of key=value pairs
  fault N  reports fault N (hexadecimal) from now on
  place    puts a stone between the fingers
  lose     the stone slips out of the closed fingers
Ends when stdin does.
"""
import argparse
import asyncio
import logging
import os
import sys
import tty

from pymodbus.datastore import ModbusServerContext, ModbusSlaveContext
from pymodbus.datastore.store import BaseModbusDataBlock
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer

UNIT = 9
COMMAND, STATUS = 0x03E8, 0x07D0
WITH_STONE = 0xBD  # where closing fingers meet a stone


class Gripper:
    def __init__(self, holding, reads):
        self.reads = reads
        self.command = [0x0900, 0x00FF, 0x0000] if holding else [0, 0, 0]
        self.active = holding
        self.activating = 0
        self.stone = holding
        self.position = WITH_STONE if holding else 0
        self.moving = 0
        self.contact = holding
        self.fault = 0
        self.writes = 0
        self.activations = 0

    def write(self, values):
        self.writes += 1
        before, self.command = self.command, list(values)
        if not values[0] & 0x0100:
            self.active = False
            self.activating = 0
        elif not self.active and not self.activating:
            self.activations += 1
            self.activating = self.reads
            self.stone = False  # the fingers run through their whole stroke
        if self.active and values[0] & 0x0800 and (values[1] & 0xFF) != (before[1] & 0xFF):
            self.moving = self.reads
            self.contact = False

    def read(self):
        if self.activating:
            self.activating -= 1
            if not self.activating:
                self.active, self.position = True, 0
        elif self.moving:
            self.moving -= 1
            if not self.moving:
                self.arrive()
        return self.registers()

    def arrive(self):
        wanted = self.command[1] & 0xFF
        self.contact = self.stone and wanted > WITH_STONE
        self.position = WITH_STONE if self.contact else wanted
        if wanted < WITH_STONE:
            self.stone = False

    def registers(self):
        status = 3 if self.active else (1 if self.activating else 0)
        thing = 0 if self.moving else (2 if self.contact else 3)
        bits = (self.command[0] >> 8 & 0x09) | status << 4 | thing << 6
        current = 0x10 if self.contact else 0
        return [bits << 8, self.fault << 8 | (self.command[1] & 0xFF), self.position << 8 | current]

    def lose(self):
        self.stone = self.contact = False
        self.moving = self.reads

    def describe(self):
        return (f"stone={int(self.stone)} active={int(self.active)} position={self.position} "
                f"writes={self.writes} activations={self.activations} command={self.command[0]:04X}")


class Commands(BaseModbusDataBlock):
    """03E8-03EA, written together."""

    def __init__(self, gripper):
        self.gripper, self.address, self.default_value, self.values = gripper, COMMAND, 0, [0, 0, 0]

    def validate(self, address, count=1):
        return address == COMMAND and count == 3

    def getValues(self, address, count=1):
        return self.gripper.command[address - COMMAND:address - COMMAND + count]

    def setValues(self, address, values):
        self.gripper.write(values)


class Status(BaseModbusDataBlock):
    """07D0-07D2."""

    def __init__(self, gripper):
        self.gripper, self.address, self.default_value, self.values = gripper, STATUS, 0, [0, 0, 0]

    def validate(self, address, count=1):
        return STATUS <= address and address + count <= STATUS + 3

    def getValues(self, address, count=1):
        return self.gripper.read()[address - STATUS:address - STATUS + count]

    def setValues(self, address, values):
        raise ValueError("input registers are not written")


def relay(loop, one, other):
    """Two pseudo terminals back to back: pymodbus opens a path, and so does its client."""
    loop.add_reader(one, lambda: os.write(other, os.read(one, 512)))
    loop.add_reader(other, lambda: os.write(one, os.read(other, 512)))


async def serve(arguments, gripper):
    loop = asyncio.get_running_loop()
    block = ModbusSlaveContext(hr=Commands(gripper), ir=Status(gripper), zero_mode=True)
    context = ModbusServerContext(slaves={UNIT: block}, single=False)
    if arguments.wire == "tcp":
        server = ModbusTcpServer(context, address=("127.0.0.1", 0))
        task = asyncio.create_task(server.serve_forever())
        await server.serving
        ready = server.server.sockets[0].getsockname()[1]
    else:
        (near, near_path), (far, far_path) = pair(), pair()
        relay(loop, near, far)
        server = ModbusSerialServer(context, port=far_path, baudrate=115200, timeout=0)
        await server.start()
        task = asyncio.create_task(server.serve_forever())
        ready = near_path
    print("READY", ready, flush=True)
    await obey(loop, gripper)
    task.cancel()


def pair():
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    return ours, os.ttyname(theirs)  # `theirs` stays open, so that a client may come and go


async def obey(loop, gripper):
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), sys.stdin)
    while line := (await reader.readline()).decode().split():
        if line[0] == "fault":
            gripper.fault = int(line[1], 16)
        elif line[0] == "place":
            gripper.stone = True
        elif line[0] == "lose":
            gripper.lose()
        print(gripper.describe(), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wire", choices=["tcp", "rtu"])
    parser.add_argument("--holding", action="store_true", help="active, with a stone in the closed fingers")
    parser.add_argument("--reads", type=int, default=3, help="status reads that a motion lasts")
    arguments = parser.parse_args()
    logging.disable(logging.CRITICAL)
    asyncio.run(serve(arguments, Gripper(arguments.holding, arguments.reads)))


if __name__ == "__main__":
    main()
