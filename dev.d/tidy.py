#!/usr/bin/env python3
"""clang-tidy over Fjord's sources, two at a time, remembering what has passed.

tidy.py BUILD [--all] [FILE...]
BUILD holds compile_commands.json. Without files: the engine's kernels (base, geometry, fractal,
texture, image, render), which take under two minutes on two cores; --all: engine, server, worker and
client. A file that passed is not looked at again until it, a header it includes or .clang-tidy has
changed (stamps in BUILD/tidy). Exit 1 if there is a finding.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ('engine/base/', 'engine/geometry/', 'engine/fractal/', 'engine/texture/', 'engine/image/',
           'engine/render/')
ALL = ('engine/', 'server/', 'worker/', 'client/')
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def project_files(path, build, seen):
    """path and every file of ours that it includes."""
    if path in seen or not path.is_file():
        return seen
    seen.add(path)
    for name in INCLUDE.findall(path.read_text('utf-8', 'replace')):
        for folder in (ROOT, build / 'proto', path.parent):
            if (folder / name).is_file():
                project_files(folder / name, build, seen)
                break
    return seen


def stamp_of(path, build):
    sha = hashlib.sha256((ROOT / '.clang-tidy').read_bytes())
    for used in sorted(project_files(path, build, set())):
        sha.update(str(used).encode() + b'\0' + used.read_bytes())
    return sha.hexdigest()


def look(path, build):
    stamps = build / 'tidy'
    stamp = stamps / stamp_of(path, build)
    if stamp.exists():
        return path, True, ''
    run = subprocess.run(['clang-tidy', '--quiet', '-p', str(build), '--extra-arg=-DHWY_COMPILE_ONLY_SCALAR', str(path)], capture_output=True, text=True)
    if run.returncode == 0:
        stamp.touch()
        return path, True, ''
    return path, False, run.stdout + '\n'.join(l for l in run.stderr.splitlines() if 'error' in l)


def main():
    arguments = sys.argv[1:]
    if not arguments:
        sys.exit(__doc__)
    build = pathlib.Path(arguments[0]).resolve()
    everything = '--all' in arguments
    named = [pathlib.Path(a).resolve() for a in arguments[1:] if a != '--all']
    if not (build / 'compile_commands.json').exists():
        sys.exit(f'{build}: no compile_commands.json; configure first')
    (build / 'tidy').mkdir(exist_ok=True)
    known = {pathlib.Path(e['directory'], e['file']).resolve()
             for e in json.loads((build / 'compile_commands.json').read_text())}
    if named:
        files = named
    else:
        folders = ALL if everything else KERNELS
        files = [f for f in known if f.is_relative_to(ROOT) and
                 f.relative_to(ROOT).as_posix().startswith(folders) and f.is_file()]
    if not files:
        sys.exit('tidy: no files to look at')
    start = time.monotonic()
    failed = 0
    # The largest first, so that none is left over at the end.
    files = sorted(set(files), key=lambda f: (-f.stat().st_size, f))
    with concurrent.futures.ThreadPoolExecutor(min(os.cpu_count() or 1, 8)) as pool:
        for path, ok, text in pool.map(lambda f: look(f, build), files):
            if not ok:
                failed += 1
                print(text.strip() or f'{path}: clang-tidy failed')
    print(f'clang-tidy: {len(files)} files, {failed} with findings, {time.monotonic() - start:.0f} s')
    sys.exit(1 if failed else 0)


main()
