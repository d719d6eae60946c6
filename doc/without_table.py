#!/usr/bin/env python3
"""One table from the campaigns of FOLDER...: what each ingredient buys."""
import json
import pathlib
import sys


def main():
    measures = {"place_error_mm": "place mm", "speed_error_mmps": "speed mm/s", "heading_error_deg": "heading deg",
                "lateral_error_mm": "lateral mm", "yaw_after_alignment_deg": "yaw aligned deg"}
    print("| RMS (largest) | " + " | ".join(measures.values()) + " | throws | as wanted |")
    print("|---|" + "--:|" * (len(measures) + 2))
    for folder in sys.argv[1:]:
        name = pathlib.Path(folder).name.replace("without-", "without ").replace("without nothing", "with all")
        summary = json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))
        cells = [f"{x['rms']:.3g} ({x['largest']:.3g})" if x["count"] else "none"
                 for x in (summary["measures"][m] for m in measures)]
        print(f"| {name} | " + " | ".join(cells) + f" | {summary['throws']} | {summary['ok']} |")


if __name__ == "__main__":
    main()
