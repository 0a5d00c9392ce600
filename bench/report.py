#!/usr/bin/env python3
"""./dev bench: runs the benches and the farm, prints one report (docs/performance.md says how).

Environment: FJORD, the program; BUILD, the build folder. Everything is measured on the machine as it
is: the report names the machine and its load before the start, so that figures of a busy machine are
known as such.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import paired

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("BUILD", ROOT / "build" / "release"))
FJORD = os.environ.get("FJORD", str(BUILD / "client" / "fjord"))
DEMO = str(ROOT / "examples" / "taiwan-rising.scene")


def say(text):
    print(text, file=sys.stderr, flush=True)


def run(arguments, **options):
    done = subprocess.run(arguments, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"bench: {' '.join(map(str, arguments))} failed:\n{done.stderr[-2000:]}")
    return done.stdout


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = re.search(r"model name\s*:\s*(.*)", text)
    flags = re.search(r"flags\s*:\s*(.*)", text)
    flags = set(flags.group(1).split()) if flags else set()
    cache = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
    compiler = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", cache)
    version = run([compiler.group(1), "--version"]).splitlines()[0] if compiler else "unknown"
    return {
        "cpu": model.group(1) if model else platform.machine(),
        "architecture": platform.machine(),
        "cores": os.cpu_count(),
        "simd": [name for name in ("sse2", "ssse3", "sse4_1", "avx2", "avx512f", "avx512dq")
                 if name in flags],
        "compiler": version,
        "build_type": re.search(r"CMAKE_BUILD_TYPE:\w+=(.*)", cache).group(1),
        "load_before": round(os.getloadavg()[0], 2),
    }


def google_benchmark(name):
    """Every benchmark of a program; the medians of three interleaved rounds."""
    program = BUILD / "bench" / name
    out = run([program, "--benchmark_format=json", "--benchmark_repetitions=3",
               "--benchmark_enable_random_interleaving=true",
               "--benchmark_report_aggregates_only=true"])
    rows = {}
    for row in json.loads(out)["benchmarks"]:
        if row.get("aggregate_name") != "median":
            continue
        kept = paired.figures(row)
        if row.get("label"):
            kept["label"] = row["label"]
        for counter in ("frames_per_s", "whole_triangles", "times_whole", "leaves"):
            if counter in row:
                kept[counter] = row[counter]
        rows[row["run_name"]] = {key: round(value, 4) if isinstance(value, float) else value
                                 for key, value in kept.items()}
    return rows


def demo_rate(threads):
    """The whole demo as a user runs it: read, inbetween, render, encode, write."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        done = json.loads(run([FJORD, "render", DEMO, "-o", folder, "--threads", str(threads), "--json"]))
        seconds = time.monotonic() - start
        return {"frames": done["rendered"], "seconds": round(seconds, 3),
                "frames_per_s": round(done["rendered"] / seconds, 3),
                "triangles_made": done["triangles_made"]}


def peak_memory(pixels):
    """Peak resident memory of one demo frame at 1080p, in MB."""
    with tempfile.TemporaryDirectory() as folder:
        before = subprocess.Popen(
            [FJORD, "render", DEMO, "-o", folder, "--threads", "1", "--frames", "96", "--size", "1920x1080",
             "--set", f"objects[island].fractal.pixels={pixels}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(before.pid, 0)
        before.returncode = os.waitstatus_to_exitcode(status)
        if before.returncode != 0:
            sys.exit("bench: the frame for the memory figure failed")
        return round(usage.ru_maxrss / 1024, 1)


def cpu_of_tree(root):
    """User and system time of a process, of those below it and of those that they have waited for."""
    parents, times = {}, {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
        except OSError:
            continue  # gone meanwhile
        parents[int(entry.name)] = int(fields[1])
        times[int(entry.name)] = sum(map(int, fields[11:15]))
    total, below = 0, {root}
    while below:
        total += sum(times.get(process, 0) for process in below)
        below = {process for process, parent in parents.items() if parent in below}
    return total / os.sysconf("SC_CLK_TCK")


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Farm:
    """`fjord farm` with workers of one thread each, and the log it leaves."""

    def __init__(self, folder, workers):
        self.log = open(pathlib.Path(folder) / "farm.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [FJORD, "farm", "--workers", str(workers), "--threads", "1", "--data", f"{folder}/data",
             "--listen", "127.0.0.1:0", "--with-parent"],
            stdout=subprocess.PIPE, stderr=self.log, text=True)
        line = self.process.stdout.readline()
        if not line.startswith("listening on "):
            sys.exit("bench: the farm did not start")
        self.environment = dict(os.environ, FJORD_SERVER=line.split()[-1])

    def fjord(self, *arguments):
        return run([FJORD, *arguments], env=self.environment)

    def workers(self):
        return sum(worker["state"] == "alive" for worker in json.loads(self.fjord("workers", "--json")))

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait()
        self.log.seek(0)
        return self.log.read()


def direct_round(bounds, settings):
    """Wall seconds, the mean of two processes that share the frames, and CPU seconds of both."""
    with tempfile.TemporaryDirectory() as folder:
        cpu, start, busy = cpu_of_children(), time.monotonic(), []
        halves = [subprocess.Popen(
            [FJORD, "render", DEMO, "-o", f"{folder}/{low}", "--threads", "1", "--frames",
             f"{low}-{high}", *settings], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for low, high in bounds]
        for child in halves:
            if child.wait() != 0:
                sys.exit("bench: a direct render failed")
            busy.append(time.monotonic() - start)
        # Frames of the two halves differ a little in cost: what counts is the work, not the later.
        return sum(busy) / len(busy), cpu_of_children() - cpu


def farm_round(first, last, settings):
    """Wall and CPU seconds from submit to the end of the job, and what the journal did."""
    with tempfile.TemporaryDirectory() as folder:
        farm = Farm(folder, 2)
        while farm.workers() < 2:
            time.sleep(.05)
        cpu = cpu_of_tree(farm.process.pid) + cpu_of_children()
        start = time.monotonic()
        job = json.loads(farm.fjord("submit", DEMO, "--frames", f"{first}-{last}", *settings, "--wait",
                                    "--json"))
        wall = time.monotonic() - start
        cpu = cpu_of_tree(farm.process.pid) + cpu_of_children() - cpu
        if job["job"]["state"] != "done":
            sys.exit("bench: the farm's job did not end well")
        log = farm.stop()
    found = re.search(r"journal: (\d+) syncs, (\d+) records, (\d+) bytes, largest batch (\d+)", log)
    journal = {}
    if found:
        syncs, records, size_bytes, largest = map(int, found.groups())
        journal = {"syncs": syncs, "records": records, "bytes": size_bytes, "largest_batch": largest,
                   "records_per_sync": round(records / max(1, syncs), 2),
                   "syncs_per_s": round(syncs / wall, 2)}
    return wall, cpu, journal


def farm_overhead(frames, size, rounds=5):
    """Two workers on two cores against the same frames rendered directly by two processes.

    Both sides have two processes of one thread; the direct ones write frames and manifest as `render`
    does. Every round has one of each, one straight after the other, and gives one overhead; the
    report holds their median.
    """
    settings = ["--size", size]
    first, half = 97 - frames, frames // 2
    pairs, journal = [], {}
    for number in range(rounds):
        direct = direct_round(((first, first + half - 1), (first + half, 96)), settings)
        wall, cpu, journal = farm_round(first, 96, settings)
        pairs.append((direct[0], wall, direct[1], cpu))
        say(f"  round {number + 1}: direct {direct[0]:.2f} s, {direct[1]:.2f} s CPU; "
            f"farm {wall:.2f} s, {cpu:.2f} s CPU")
    wall_shares = [farm / direct - 1 for direct, farm, _, _ in pairs]
    cpu_shares = [farm / direct - 1 for _, _, direct, farm in pairs]
    return {
        "frames": frames, "size": size, "workers": 2, "rounds": rounds,
        "frame_cpu_s": round(statistics.median(pair[2] for pair in pairs) / frames, 4),
        "overhead_cpu_share": round(statistics.median(cpu_shares), 4),
        "overhead_cpu_shares": [round(share, 4) for share in cpu_shares],
        "overhead_wall_share": round(statistics.median(wall_shares), 4),
        "overhead_wall_shares": [round(share, 4) for share in wall_shares],
        "journal": journal,
    }


def show_pairs(report):
    print(f"{'':44} {'':16} {'before':>14} {'after':>14}")
    for row, values in report["paired"].items():
        for key, (before, after) in values.items():
            ratio = f"{before / after:8.2f} times" if before and after else ""
            print(f"{row:44} {key:16} {before if before is not None else '-':>14} "
                  f"{after if after is not None else '-':>14} {ratio}")


def show(report):
    print(json.dumps(report["machine"], indent=1))
    for name in ("fractal", "render"):
        for row, values in report[name].items():
            print(f"{row:44} " + "  ".join(f"{key} {value}" for key, value in values.items()))
    for name in ("demo", "memory_mb", "farm"):
        print(name, json.dumps(report[name], indent=1))


def main():
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true", help="one JSON document on standard output")
    parser.add_argument("--quick", action="store_true", help="the farm and the demo only")
    parser.add_argument("--baseline", metavar="FOLDER", help="compare with the programs in FOLDER "
                        "(a build folder or a copy of one), in turn, and nothing else")
    parser.add_argument("--rounds", type=int, default=5, help="of --baseline (default 5)")
    options = parser.parse_args()
    if options.baseline:
        report = {"machine": machine(),
                  "paired": paired.compare(options.baseline, BUILD, DEMO, options.rounds, say)}
        if options.json:
            print(json.dumps(report, indent=1))
        else:
            show_pairs(report)
        return
    report = {"machine": machine(), "fractal": {}, "render": {}}
    if not options.quick:
        for name in ("fractal", "render"):
            say(f"bench: {name}")
            report[name] = google_benchmark(f"fjord_{name}_bench")
    say("bench: the demo on 1 and 2 threads")
    report["demo"] = {f"threads_{threads}": demo_rate(threads) for threads in (1, 2)}
    say("bench: memory at 1 and 1/8 pixel")
    report["memory_mb"] = {"pixels_1": peak_memory(1), "pixels_1_8": peak_memory(.125)}
    say("bench: farm overhead")
    report["farm"] = farm_overhead(48, "1920x1080")
    if options.json:
        print(json.dumps(report, indent=1))
    else:
        show(report)


if __name__ == "__main__":
    main()
