#!/usr/bin/env python3
"""The architecture as a check: which folder may include which, and what pure code must not touch.

Linking enforces the same for code; this also covers headers. Exits 1 and names file and line of each breach.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# A folder may include itself and these.
MAY_INCLUDE = {
    "vision": ["vision"],
    "servo": ["servo", "vision/percepts"],
    "hw": ["hw", "vision", "servo/game"],
    "src": ["src", "servo", "hw", "vision"],
}
# Adapters know the ports and themselves, not each other; simulated devices know no adapter.
ADAPTERS = ["socketcan", "canopen", "modbus", "dsp3000", "aravis", "digital_curling", "files", "link", "sim",
            "shared_frames", "udp_can", "local_switch"]

# The supervisor knows no controller: only what both sides exchange.
SUPERVISOR_MAY_INCLUDE = ["servo/safety", "servo/command.hpp", "servo/observation.hpp", "servo/thrower_config.hpp",
                          "servo/unicycle.hpp", "vision/percepts"]

PURE_FORBIDS = {
    r"_clock::now": "reads a clock",
    r"std::thread|std::jthread|std::mutex|std::async": "uses threads",
    r"std::cout|std::cerr|(?<!sn)printf\(": "prints",
    r"<fstream>|<filesystem>|cv::imread|cv::imwrite": "touches files",
    r"vpDisplay|cv::imshow|highgui": "opens a display",
    r"<sys/socket|<linux/can|<modbus": "talks to a bus",
    r"std::random_device|\brand\(\)": "is random without a seed",
}

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')


def allowed(path, target):
    top = path.parts[0]
    if not any(target == p or target.startswith(p + "/") for p in MAY_INCLUDE[top]):
        return f"{top}/ must not include {target}"
    if path.parts[:2] == ("servo", "safety"):
        if not any(target == p or target.startswith(p + "/") for p in SUPERVISOR_MAY_INCLUDE):
            return f"servo/safety must not include {target}: the supervisor knows no controller"
    if top == "hw" and len(path.parts) > 2 and target.startswith("hw/"):
        adapter, parts = path.parts[1], target.split("/")
        if len(parts) > 2 and parts[1] in ADAPTERS and parts[1] != adapter:
            return f"hw/{adapter} must not include {target}: adapters know only the ports"
    return None


def breaches(path):
    relative = path.relative_to(ROOT)
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        include = INCLUDE.match(line)
        if include and "/" in include.group(1):
            problem = allowed(relative, include.group(1))
            if problem:
                yield f"{relative}:{number}: {problem}"
        if relative.parts[0] in ("vision", "servo"):
            for pattern, problem in PURE_FORBIDS.items():
                if re.search(pattern, line.split("//")[0]):
                    yield f"{relative}:{number}: pure code {problem}: {line.strip()}"


def main():
    found = [b for top in MAY_INCLUDE for suffix in ("*.hpp", "*.cpp") for f in sorted((ROOT / top).rglob(suffix)) for b in breaches(f)]
    print("\n".join(found) if found else "layering holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
