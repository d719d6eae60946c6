#!/usr/bin/env python3
"""Puts games of both robots together: ends_table.py FOLDER... (each with figures.json, throws.csv and game.jsonl). Markdown to stdout."""
import csv
import json
import math
import pathlib
import sys


def ice_rows(throws):
    """How the foretold places came nearer to where the stones lay."""
    groups = [(0, 0), (1, 3), (4, 7), (8, 15), (16, 31), (32, 10**9)]
    for low, high in groups:
        told = [t for t in throws if t["foretold_error_m"] and low <= int(t["learnt_from"]) <= high]
        if not told:
            continue
        error = math.sqrt(sum(float(t["foretold_error_m"]) ** 2 for t in told) / len(told))
        sigma = sum(float(t["foretold_sigma_m"]) for t in told) / len(told)
        name = str(low) if low == high else f"{low} and more" if high > 10**6 else f"{low} to {high}"
        yield f"| {name} | {len(told)} | {error:.2f} | {sigma:.2f} |"


def called_measures(folder):
    """Ends of which the skip itself says that the stones would have to be measured."""
    with (folder / "game.jsonl").open(encoding="utf-8") as lines:
        return sum(1 for line in lines if json.loads(line).get("measure"))


def main():
    folders = [pathlib.Path(word) for word in sys.argv[1:]]
    if not folders:
        sys.exit(__doc__.strip())
    figures = [json.loads((f / "figures.json").read_text(encoding="utf-8")) for f in folders]
    throws = [row for f in folders for row in csv.DictReader((f / "throws.csv").open(encoding="utf-8"))]
    s = {key: sum(f[key] for f in figures) for key in figures[0]}
    worst = max(f["worst_m"] for f in figures)
    rows = [
        ("games, ends, throws", f"{len(folders)}, {s['ends']}, {s['throws']}"),
        ("throws that struck a stone; told wrongly", f"{s['struck']}; {s['struck_wrong']}"),
        ("**disagreements** of score, fouls or stones in play with the truth", f"**{s['disagreements']}**"),
        ("... and such as truth decides by less than 2 cm", str(s["too_close_disagreements"])),
        ("ends whose score truth decides by less than 2 cm", str(s["too_close_ends"])),
        ("ends of which the skip says that they are to be measured", str(sum(map(called_measures, folders)))),
        ("stones' places, seen less true: RMS, worst", f"{1e3 * math.sqrt(s['square_m2'] / max(1, s['places'])):.1f} mm, {1e3 * worst:.0f} mm"),
        ("stones given away (no such shot); attempts repeated; throws with a remark of the skip's",
         f"{s['given_away']}; {s['repeated']}; {s['remarked']}"),
        ("a turn on the rink's clock", f"{s['simulated_s'] / s['turns']:.0f} s"),
        ("times faster than real time, on this machine", f"{s['simulated_s'] / s['wall_s']:.1f}"),
    ]
    print("| figure | value |\n|---|--:|")
    for what, value in rows:
        print(f"| {what} | {value} |")
    print("\nThe place foretold from the thrower's release and the ice as known before, against where the stone lay (those that met"
          "\nnothing):\n\n| ice learnt from throws | stones | error RMS, m | foretold sigma, m |\n|---|--:|--:|--:|")
    for row in ice_rows(throws):
        print(row)


if __name__ == "__main__":
    main()
