#!/usr/bin/env python3
"""Draws the house from its includes: house.py prints the wings by floor, each with its lines, its rooms and the wings
that it uses; --write puts the picture without lines into docs/architecture.md, and --check fails if the page has
another. house.py UNIT (fit/posterior/mode, say) prints the units that UNIT reaches by includes of headers and of their
sources, by wing."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAYERS = (ROOT / "cmake/layers.cmake").read_text()
WINGS = {wing: rooms.split() for wing, rooms in re.findall(r"set\(MYOID_WING_(\w+)\s+([^)]*)\)", LAYERS)}
BEGIN, END = "<!-- house.py writes this -->\n", "<!-- to here -->\n"


def sources():
    return [f for f in sorted((ROOT / "myoid").rglob("*")) if f.suffix in (".h", ".cpp") and ".test" not in f.name]


def unit(path):
    return re.sub(r"\.(h|cpp)$", "", str(path))


def includes():
    """Returns by unit the units that it includes, and by wing its lines."""
    used, lines = {}, dict.fromkeys(WINGS, 0)
    for file in sources():
        name = file.relative_to(ROOT / "myoid")
        text = file.read_text()
        lines[name.parts[0]] += text.count("\n")
        used.setdefault(unit(name), set()).update(map(unit, re.findall(r'#include "myoid/([^"]*)"', text)))
    return {name: others - {name} for name, others in used.items()}, lines


def picture(with_lines):
    used, lines = includes()
    wings = {wing: set() for wing in WINGS}
    for name, others in used.items():
        wing = name.split("/")[0]
        wings[wing] |= {other.split("/")[0] for other in others} - {wing}

    def floor(wing):
        return 1 + max((floor(other) for other in wings[wing]), default=0)

    def number(count):
        return f"{count:6}  " if with_lines else ""

    rows = [f"floor  {'wing':9}  {'lines   ' if with_lines else ''}rooms; on the wings that they use"]
    for wing in sorted(WINGS, key=lambda w: (-floor(w), w)):
        uses = sorted(wings[wing], key=lambda w: (floor(w), w))
        rows.append(f"{floor(wing):5}  {wing:9}  {number(lines[wing])}{', '.join(WINGS[wing])}")
        if uses:
            rows.append(f"{'':{26 if with_lines else 18}}on {', '.join(uses)}")
    rows.append(f"{'':18}{number(sum(lines.values()))}{len(WINGS)} wings, {sum(map(len, WINGS.values()))} rooms, "
                f"{sum(map(len, wings.values()))} arrows between wings")
    return "\n".join(rows)


def walk(start):
    used, _ = includes()
    if start not in used:
        sys.exit(f"no unit myoid/{start}")
    seen, todo = set(), [start]
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += used.get(name, ())
    for wing in reversed(WINGS):
        here = sorted(name for name in seen if name.split("/")[0] == wing)
        if here:
            print(f"{wing} ({len(here)})\n  " + "\n  ".join(here))


def main():
    argument = sys.argv[1] if len(sys.argv) > 1 else ""
    if argument and not argument.startswith("--"):
        return walk(argument.removeprefix("myoid/"))
    page = ROOT / "docs/architecture.md"
    text = page.read_text()
    wanted = f"{text.split(BEGIN)[0]}{BEGIN}```\n{picture(False)}\n```\n{END}{text.split(END)[1]}"
    if argument == "--check":
        return sys.exit(0 if wanted == text else f"{page}: another house; docs/house.py --write")
    if argument == "--write":
        page.write_text(wanted)
    print(picture(True))


main()
