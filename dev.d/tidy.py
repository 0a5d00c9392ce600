#!/usr/bin/env python3
"""clang-tidy over Fjord's sources, one a core, remembering by content what has passed (green.py).

tidy.py BUILD [--all] [--anew] [FILE...]
BUILD holds compile_commands.json. Without files: the engine's kernels (base, geometry, fractal,
texture, image, render), which take two minutes on two cores; --all: engine, server, worker and
client. A file that passed is not looked at again until it, a header of ours that it includes, its
compiler flags, .clang-tidy or clang-tidy has changed; --anew looks at every one. Exit 1 if there is
a finding.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

sys.dont_write_bytecode = True
import green  # noqa: E402

ROOT = green.ROOT
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
                project_files((folder / name).resolve(), build, seen)
                break
    return seen


class Tidy:
    def __init__(self, build, anew):
        self.build = build
        self.anew = anew
        version = subprocess.run(['clang-tidy', '--version'], capture_output=True, text=True, check=True)
        self.version = version.stdout
        # Flags by file, without the checkout's own folder: all checkouts share what has passed.
        self.flags = {
            pathlib.Path(e['directory'], e['file']).resolve(): e['command'].replace(str(build), 'BUILD').replace(str(ROOT), 'ROOT')
            for e in json.loads((build / 'compile_commands.json').read_text('utf-8'))}

    def key(self, path):
        used = sorted(project_files(path, self.build, set()))
        return green.key(['tidy', self.version, self.flags.get(path, '')], [ROOT / '.clang-tidy', *used])

    def look(self, path):
        """(passed, looked at, what it says)"""
        key = self.key(path)
        if not self.anew and green.has(key):
            return True, False, ''
        run = subprocess.run(['clang-tidy', '--quiet', '-p', str(self.build),
                              '--extra-arg=-DHWY_COMPILE_ONLY_SCALAR', str(path)],
                             capture_output=True, text=True, check=False)
        if run.returncode == 0:
            green.note(key)
            return True, True, ''
        errors = '\n'.join(line for line in run.stderr.splitlines() if 'error' in line)
        return False, True, (run.stdout + errors).strip() or f'{path}: clang-tidy failed'


def main():
    flags = {a for a in sys.argv[1:] if a.startswith('--')}
    arguments = [a for a in sys.argv[1:] if a not in flags]
    if not arguments or flags - {'--all', '--anew'}:
        sys.exit(__doc__)
    build = pathlib.Path(arguments[0]).resolve()
    if not (build / 'compile_commands.json').exists():
        sys.exit(f'{build}: no compile_commands.json; configure first')
    tidy = Tidy(build, '--anew' in flags)
    files = [pathlib.Path(a).resolve() for a in arguments[1:]]
    if not files:
        folders = ALL if '--all' in flags else KERNELS
        files = [f for f in tidy.flags if f.is_relative_to(ROOT) and
                 f.relative_to(ROOT).as_posix().startswith(folders) and f.is_file()]
    if not files:
        sys.exit('tidy: no files to look at')
    start = time.monotonic()
    # The largest first, so that none is left over at the end.
    files = sorted(set(files), key=lambda f: (-f.stat().st_size, f))
    with concurrent.futures.ThreadPoolExecutor(min(os.cpu_count() or 1, 8)) as pool:
        answers = list(pool.map(tidy.look, files))
    failed = [text for passed, _, text in answers if not passed]
    for text in failed:
        print(text)
    looked = sum(1 for _, at, _ in answers if at)
    print(f'clang-tidy: {len(files)} files, {looked} looked at, {len(failed)} with findings, '
          f'{time.monotonic() - start:.0f} s')
    sys.exit(1 if failed else 0)


main()
