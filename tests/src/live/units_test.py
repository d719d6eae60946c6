#!/usr/bin/env python3
"""systemd itself reads the units, and finds nothing to complain of: units_test.py HOGLINE UNIT_FOLDER

The program stands in the place of /usr/bin/hogline; and what ExecStart says after it, the program understands."""
import pathlib
import shlex
import subprocess
import sys
import tempfile


def commands(unit):
    """What it starts, a list of words each."""
    return [shlex.split(line.split("=", 1)[1]) for line in unit.read_text().splitlines() if line.startswith("ExecStart=")]


def verdict(units):
    checked = subprocess.run(["systemd-analyze", "verify", "--man=no", *map(str, units)], capture_output=True, text=True)
    return checked.returncode, checked.stdout + checked.stderr


def main(program, folder):
    problems = []
    with tempfile.TemporaryDirectory() as here:
        copies = []
        for unit in sorted(pathlib.Path(folder).iterdir()):
            copies.append(pathlib.Path(here) / unit.name)
            copies[-1].write_text(unit.read_text().replace("/usr/bin/hogline", program))
        if len(copies) != 3:
            problems.append(f"three units are expected, not {copies}")
        status, words = verdict(copies)
        if status != 0 or words:
            problems.append(f"systemd-analyze verify: {status}\n{words}")
        # It would have found a mistake.
        broken = pathlib.Path(here) / "broken.service"
        broken.write_text(copies[-1].read_text().replace("Type=notify", "Type=notfy").replace("ExecStart=", "ExecStart=/nowhere"))
        if verdict([broken]) == (0, ""):
            problems.append("systemd-analyze finds nothing in a broken unit either")
        for unit in copies:
            for command in commands(unit):
                command = [word.replace("/etc/hogline", here + "/none") for word in command]
                said = subprocess.run(command, capture_output=True, text=True, timeout=60)
                if said.returncode == 0 or here + "/none" not in said.stdout + said.stderr:
                    problems.append(f"{command} does not ask for its rig file: {said.returncode}\n{said.stdout}{said.stderr}")
    print("\n".join(problems) or "systemd accepts the units")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
