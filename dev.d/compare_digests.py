#!/usr/bin/env python3
"""compare_digests.py GOLDEN RUN.txt...: do all runs of fjord_probe give the golden digests?

Lines are "name digest". Prints each item that differs or is missing, and in which runs; exit 1 then.
compare_digests.py --update GOLDEN RUN.txt...   writes the list anew, if all runs agree.
"""
import pathlib
import sys


def read(path):
    lines = pathlib.Path(path).read_text('utf-8').split('\n')
    return dict(line.rsplit(' ', 1) for line in lines if line and not line.startswith('#'))


def main():
    update = sys.argv[1:2] == ['--update']
    arguments = sys.argv[2:] if update else sys.argv[1:]
    if len(arguments) < 2:
        sys.exit(__doc__)
    golden_path, paths = arguments[0], arguments[1:]
    runs = {pathlib.Path(p).stem: read(p) for p in paths}
    golden = next(iter(runs.values())) if update else read(golden_path)
    if not golden:
        sys.exit(f'{golden_path}: the list is empty')
    bad = 0
    for name in list(golden) + sorted({n for run in runs.values() for n in run} - set(golden)):
        wrong = [f'{run} {values.get(name, "has none")}' for run, values in runs.items()
                 if values.get(name) != golden.get(name)]
        if wrong:
            bad += 1
            if bad <= 40:
                print(f'{name}: {golden.get(name, "not in the list")}, but {"; ".join(wrong[:6])}'
                      + (f'; and {len(wrong) - 6} runs more' if len(wrong) > 6 else ''))
    if bad > 40:
        print(f'... and {bad - 40} items more')
    if bad:
        agree = [run for run, values in runs.items() if values == golden]
        print(f'{bad} of {len(golden)} items differ. Equal to the list: {", ".join(agree) or "none"}.')
        sys.exit(1)
    if update:
        head = ('# Golden digests of fjord_probe (docs/determinism.md). A line changes only with the version that\n'
                '# covers it and a line in CHANGELOG.md. Written by dev.d/portability.sh --update.\n')
        pathlib.Path(golden_path).write_text(head + ''.join(f'{n} {d}\n' for n, d in golden.items()), 'utf-8')
    print(f'{len(golden)} items, {len(runs)} runs: all equal')


main()
