#!/usr/bin/env python3
"""A knob's name stands in its registry's table, in kernels, tests and examples, and nowhere else.

check_knobs.py FJORD [ROOT]   prints file:line: message for every text in quotes that is the name of
                              a knob; exit 1 if there is one
check_knobs.py --self-test FJORD   plants one and sees it found
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

FOLDERS = ['engine/animation', 'engine/formats', 'engine/image', 'engine/knobs', 'engine/render',
           'engine/scene', 'client', 'server', 'worker']
# These read and write the parameter files of 1989 and the scenes that `fjord import` makes of them.
FORMATS = {'engine/formats/par_file.cpp', 'engine/formats/import.cpp'}
# Names of other things as well: of a method, of a layer, of an attribute of SVG, of what every object has.
SHARED = {'coast', 'color', 'seed', 'width'}


def names(fjord):
    told = json.loads(subprocess.run([fjord, 'presets', '--json'], check=True, text=True,
                                     stdout=subprocess.PIPE).stdout)
    found = set()

    def walk(value):
        if isinstance(value, dict):
            for knob in value.get('knobs', []):
                found.add(knob['name'])
            for part in value.values():
                walk(part)
        elif isinstance(value, list):
            for part in value:
                walk(part)

    walk(told)
    return found - SHARED


def faults(root, knobs):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob('*')):
            name = path.relative_to(root).as_posix()
            if path.suffix not in {'.cpp', '.h'} or name in FORMATS:
                continue
            for number, line in enumerate(path.read_text('utf-8').split('\n'), 1):
                for text in re.findall(r'"((?:\\.|[^"\\])*)"', line.split('//')[0]):
                    if text in knobs:
                        yield f'{name}:{number}: "{text}" is the name of a knob: ask its registry'


def main():
    args = [a for a in sys.argv[1:] if a != '--self-test']
    knobs = names(args[0])
    if len(knobs) < 10:
        sys.exit(f'check_knobs: error: only {len(knobs)} knobs found; what has become of presets --json?')
    if '--self-test' in sys.argv:
        with tempfile.TemporaryDirectory() as folder:
            planted = pathlib.Path(folder, 'engine/scene/planted.cpp')
            planted.parent.mkdir(parents=True)
            planted.write_text('if (knob.name == "amplitude") return;\n', 'utf-8')
            if len(list(faults(pathlib.Path(folder), knobs))) != 1:
                sys.exit('check_knobs: error: a planted fault was not found')
    root = pathlib.Path(args[1]) if len(args) > 1 else pathlib.Path(__file__).resolve().parent.parent
    found = list(faults(root, knobs))
    print('\n'.join(found) if found else f'{len(knobs)} knobs are named by their registries alone')
    sys.exit(1 if found else 0)


main()
