#!/usr/bin/env python3
"""Puts the tables of the load test into the document: write_load.py LOG DOCUMENT"""
import datetime
import pathlib
import re
import sys

BEGIN, END = "<!-- load:begin -->", "<!-- load:end -->"

log = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8", errors="replace").splitlines()
lines = [line for line in log if line.startswith("|") or re.match(r"    .*(ms +\d+|command on the bus)$", line)]
if sum(line.startswith("| ") for line in lines) != 4:
    sys.exit("write_load: the log does not hold the two tables; see " + sys.argv[1])

text, last = "", ""
for line in lines:
    kind = line[0]
    text += ("\n" if last and (kind != last or not line.startswith("|") and "command" in line or
                               line.startswith("| simulated")) else "") + line.rstrip() + "\n"
    last = kind

document = pathlib.Path(sys.argv[2])
before, rest = document.read_text(encoding="utf-8").split(BEGIN)
after = rest.split(END)[1]
document.write_text(f"{before}{BEGIN}\nMeasured {datetime.date.today()}.\n\n{text}{END}{after}", encoding="utf-8")
