"""Two builds against each other, in turn, so that a slow spell of the machine hits both alike.

A figure is the least of all rounds: what the machine does beside makes a round slower, never faster.
Where `perf` may count, the instructions of one frame come with it, which a busy machine hardly moves.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

FILTERS = {
    "fjord_fractal_bench": r"stream/.*/2048|weld",
    "fjord_render_bench": r"MicroTriangles|DemoFrame1080",
}
UNIT_MS = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}


def find(folder, name):
    """A program in a build folder. A copy of one needs its programs and engine/image, where they lie."""
    for place in ("bench", "client"):
        path = pathlib.Path(folder) / place / name
        if path.is_file():
            return path
    sys.exit(f"bench: there is no {name} in {folder}; name a build folder, or a copy of its "
             "bench/fjord_fractal_bench, bench/fjord_render_bench, client/fjord and "
             "engine/image/fjord_picture_files.so")


def figures(row):
    kept = {"cpu_ms": row["cpu_time"] * UNIT_MS[row["time_unit"]]}
    for counter, unit in (("s_per_midpoint", "ns_per_midpoint"), ("s_per_leaf", "ns_per_leaf")):
        if counter in row:
            kept[unit] = row[counter] * 1e9
    if "triangles_per_s" in row:
        kept["ns_per_triangle"] = 1e9 / row["triangles_per_s"]
        kept["triangles"] = row["triangles"]
    return kept


def one_round(program, pattern, best):
    done = subprocess.run([program, "--benchmark_format=json", f"--benchmark_filter={pattern}",
                           "--benchmark_min_time=0.05"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"bench: {program} failed:\n{done.stderr[-2000:]}")
    for row in json.loads(done.stdout)["benchmarks"]:
        if row.get("run_type") == "aggregate":
            continue
        kept = best.setdefault(row["name"], {})
        for key, value in figures(row).items():
            kept[key] = round(min(kept.get(key, value), value), 3)


def instructions(program, scene):
    """Of `fjord render` for the demo's last frame at 1080p; None where nothing counts."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            done = subprocess.run(
                ["perf", "stat", "-x", ",", "-e", "instructions:u", program, "render", scene, "-o",
                 folder, "--threads", "1", "--frames", "96", "--size", "1920x1080"],
                capture_output=True, text=True, check=False)
        except OSError:
            return None
        found = re.search(r"^(\d+),,instructions", done.stderr, re.MULTILINE)
        return int(found.group(1)) if done.returncode == 0 and found else None


def compare(before, after, scene, rounds, say):
    """{row: {figure: [before, after]}}; None where a build does not have a row."""
    sides = {"before": before, "after": after}
    best = {side: {} for side in sides}
    for number in range(rounds):
        say(f"bench: round {number + 1} of {rounds}")
        for name, pattern in FILTERS.items():
            for side, folder in sides.items():
                one_round(find(folder, name), pattern, best[side])
    report = {}
    for row in list(best["after"]) + [row for row in best["before"] if row not in best["after"]]:
        pair = [best[side].get(row, {}) for side in sides]
        keys = list(pair[1]) + [key for key in pair[0] if key not in pair[1]]
        report[row] = {key: [values.get(key) for values in pair] for key in keys}
    counted = [instructions(find(folder, "fjord"), scene) for folder in sides.values()]
    report["render/1080p"] = {"instructions": counted}
    return report
