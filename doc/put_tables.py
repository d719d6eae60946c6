#!/usr/bin/env python3
"""Puts files between the marks of a document: put_tables.py DOCUMENT NAME=FILE...

Each NAME has a pair of lines <!-- NAME:begin --> and <!-- NAME:end -->; what stands between them is replaced.
"""
import pathlib
import sys


def main():
    if len(sys.argv) < 3 or any("=" not in word for word in sys.argv[2:]):
        sys.exit(__doc__.strip())
    document = pathlib.Path(sys.argv[1])
    text = document.read_text(encoding="utf-8")
    for word in sys.argv[2:]:
        name, path = word.split("=", 1)
        begin, end = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            sys.exit(f"{document}: needs one pair of lines {begin} and {end}")
        head, rest = text.split(begin)
        _, tail = rest.split(end)
        text = head + begin + "\n\n" + pathlib.Path(path).read_text(encoding="utf-8").strip() + "\n\n" + end + tail
    document.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
