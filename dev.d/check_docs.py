#!/usr/bin/env python3
"""The tables of docs/knobs.md are those that the registries make: `fjord presets --markdown`.

check_docs.py FJORD            says whether the page is stale; exit 1 if it is
check_docs.py FJORD --update   writes the tables anew
"""
import pathlib
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / 'docs/knobs.md'
BEGIN, END = '<!-- begin of what fjord presets --markdown prints -->\n', '<!-- end -->\n'


def main():
    tables = subprocess.run([sys.argv[1], 'presets', '--markdown'], check=True, text=True,
                            stdout=subprocess.PIPE).stdout
    page = PAGE.read_text('utf-8')
    if page.count(BEGIN) != 1 or page.count(END) != 1 or not tables.strip():
        sys.exit(f'{PAGE}: error: the two marks of the tables are not there once each')
    head, tail = page[:page.index(BEGIN)], page[page.index(END):]
    fresh = head + BEGIN + '\n' + tables.rstrip('\n') + '\n\n' + tail
    if sys.argv[2:] == ['--update']:
        PAGE.write_text(fresh, 'utf-8')
    elif fresh != page:
        sys.exit('docs/knobs.md: error: the tables are stale; run dev.d/check_docs.py FJORD --update')
    else:
        print('docs/knobs.md has the tables of the registries')


main()
