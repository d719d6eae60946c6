#!/usr/bin/env python3
"""Writes doc/usage.md from the program's own --help: make_usage.py PATH_TO_HOGLINE > doc/usage.md"""
import re
import subprocess
import sys


def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout.strip()


def main():
    program = sys.argv[1]
    overview = help_of(program)
    commands = re.findall(r"^  (\w+) {2,}", overview.split("Subcommands:")[1], re.M)
    print("# Usage\n\nWritten by `./dev doc` from the program's `--help`.\n")
    print(f"## hogline\n\n```\n{overview}\n```")
    for command in commands:
        print(f"\n## hogline {command}\n\n```\n{help_of(program, command)}\n```")


if __name__ == "__main__":
    main()
