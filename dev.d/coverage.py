#!/usr/bin/env python3
"""docs/coverage.md: which tests prove which feature of the source documents.

A test that proves a feature carries its ID in its gtest name (S21_EdgeWiseRefinement). This script
reads the names from tests/, writes the table (--write), or fails where a feature that must be proved
has no test or the table is out of date (--check).
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "coverage.md"
SOURCES = {
    "S": "Shih 1989", "G": "Gaddis 1985", "M": "Martz 1996", "C": "Collins 1988", "W": "Wang 1989",
}
# Features that must have a test. The list grows with the program.
CORE = {
    "S1": "dimension from copies", "S2": "H controls roughness", "S3": "internal consistency",
    "S4": "external consistency", "S6": "level variances", "S7": "bounded Gaussian",
    "S8": "three knobs", "S10": "fixed normal", "S11": "current normal",
    "S12": "perturbed current normal", "S13": "averaged endpoint normals", "S14": "laws of amount",
    "S15": "epsilon or viewing distance", "S16": "coast triangles stay convex pieces",
    "S17": "normalising to one coast edge", "S18": "face normal opens gaps",
    "S19": "shared-edge normal", "S20": "averaged vertex normals", "S21": "edge-wise splitting",
    "S22": "coasts stay level", "S23": "any closed object", "S24": "order-free randomness",
    "S25": "inbetween", "S26": "fast look, then picture", "S27": "old files", "S28": "mesh checkers",
    "S29": "colour by height", "C16a": "animation-stable keys", "C47": "repeatability",
    "C49": "detail trade-off report", "G29": "bounded concurrency", "G44": "fixed terrain",
    "G51": "plane and normal", "G56": "scaling with workers",
}
TEST = re.compile(r"(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(\s*(\w+)\s*,\s*(\w+)\s*[,)]")
ID = re.compile(r"(?:^|_)([SGMCW]\d+a?)(?=_|$)")


def tests_by_id():
    found = {}
    for path in sorted((ROOT / "tests").rglob("*.cpp")):
        for suite, name in TEST.findall(path.read_text(encoding="utf-8")):
            for feature in ID.findall(name):
                found.setdefault(feature, []).append(
                    (f"{suite}.{name}", path.relative_to(ROOT).as_posix()))
    return found


def order(feature):
    letter, number, tail = re.fullmatch(r"([A-Z])(\d+)(a?)", feature).groups()
    return "SCGMW".index(letter), int(number), tail


def page(found):
    lines = [
        "# Coverage", "",
        "Which tests prove which feature of the five source documents. Made by `dev.d/coverage.py",
        "--write` from the tests' names; `./dev test` fails when it is out of date or when a feature",
        "that must be proved has no test.", "",
        "| ID | source | feature | tests |", "|-|-|-|-|",
    ]
    for feature in sorted(set(found) | set(CORE), key=order):
        cells = "<br>".join(f"`{test}` ({path})" for test, path in found.get(feature, []))
        lines.append(f"| {feature} | {SOURCES[feature[0]]} | {CORE.get(feature, '')} | {cells or '**none**'} |")
    return "\n".join(lines) + "\n"


def main():
    found = tests_by_id()
    text = page(found)
    if sys.argv[1:] == ["--write"]:
        PAGE.write_text(text, encoding="utf-8")
        return 0
    if sys.argv[1:] != ["--check"]:
        print("usage: coverage.py --write | --check", file=sys.stderr)
        return 2
    missing = [feature for feature in CORE if feature not in found]
    for feature in sorted(missing, key=order):
        print(f"error: no test carries {feature} ({CORE[feature]})")
    stale = not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text
    if stale:
        print("error: docs/coverage.md is out of date: run dev.d/coverage.py --write")
    return 1 if missing or stale else 0


if __name__ == "__main__":
    sys.exit(main())
