#!/usr/bin/env python3
"""Put standard input between the lines <!-- NAME:begin --> and <!-- NAME:end --> of a file: put_block.py FILE NAME."""
import sys

path, name = sys.argv[1:]
begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->"
with open(path, encoding="utf-8") as f:
    text = f.read()
if begin not in text or end not in text:
    sys.exit(f"no lines {begin.strip()} and {end} in {path}")
head, rest = text.split(begin, 1)
_, tail = rest.split(end, 1)
block = sys.stdin.read()
with open(path, "w", encoding="utf-8") as f:
    f.write(head + begin + "\n" + block.strip() + "\n\n" + end + tail)
