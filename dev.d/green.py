#!/usr/bin/env python3
"""Remembers by content what has been green, so that a check looks only at what has changed since.

A key is the digest of all that a check depends on: words (its form, versions of tools) and files.
The notes are empty files named by their keys, in $FJORD_GREEN, or else fjord/green in the user's
cache folder: all checkouts and build folders share them, and they outlive these. Notes that nobody
has asked for in 90 days go.

green.py key WORD... -- PATH...   prints the key; a folder stands for every file below it
green.py has KEY                  exit 0: it was green, 1: not known
green.py note KEY                 it is green
green.py --self-test
"""
import hashlib
import os
import pathlib
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT_DAYS = 90


def notes():
    cache = os.environ.get('XDG_CACHE_HOME') or os.path.join(os.path.expanduser('~'), '.cache')
    return pathlib.Path(os.environ.get('FJORD_GREEN') or os.path.join(cache, 'fjord', 'green'))


def name_of(path):
    """Relative to the checkout where it lies in one, so that all checkouts have the same keys."""
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name


def key(words, paths):
    sha = hashlib.sha256()
    for word in words:
        sha.update(b'word\0' + word.encode() + b'\0')
    for path in paths:
        path = pathlib.Path(path).resolve()
        files = sorted(f for f in path.rglob('*') if f.is_file()) if path.is_dir() else [path]
        for file in files:
            sha.update(b'file\0' + name_of(file).encode() + b'\0')
            sha.update(hashlib.sha256(file.read_bytes()).digest())
    return sha.hexdigest()


def has(a_key):
    try:
        os.utime(notes() / a_key)
        return True
    except OSError:
        return False


def note(a_key):
    folder = notes()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / a_key).touch()
        oldest = time.time() - KEPT_DAYS * 86400
        for old in folder.iterdir():
            if old.stat().st_mtime < oldest:
                old.unlink(missing_ok=True)
    except OSError:
        pass  # without notes every check looks at everything, which is right, and slower


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        os.environ['FJORD_GREEN'] = os.path.join(folder, 'notes')
        tree = pathlib.Path(folder, 'tree')
        tree.mkdir()
        (tree / 'a').write_text('1')
        keys = [key(['w'], [tree]), key(['v'], [tree]), key(['w', 'v'], [tree])]
        (tree / 'a').write_text('2')
        keys.append(key(['w'], [tree]))
        (tree / 'a').rename(tree / 'b')
        keys.append(key(['w'], [tree]))
        (tree / 'c').write_text('')
        keys.append(key(['w'], [tree]))
        if len(set(keys)) != len(keys):
            sys.exit('self-test: another word, content, name or file has the same key')
        if has(keys[0]):
            sys.exit('self-test: green before it was noted')
        note(keys[0])
        if not has(keys[0]) or has(keys[1]):
            sys.exit('self-test: a note is not kept, or counts for another key')
        os.utime(notes() / keys[0], (0, 0))
        note(keys[1])
        if has(keys[0]):
            sys.exit('self-test: an old note is kept for ever')
    print('self-test: what changes has another key')


def main():
    what, rest = (sys.argv[1], sys.argv[2:]) if len(sys.argv) > 1 else ('', [])
    if what == '--self-test':
        self_test()
    elif what == 'key' and '--' in rest:
        split = rest.index('--')
        print(key(rest[:split], rest[split + 1:]))
    elif what == 'has' and len(rest) == 1:
        sys.exit(0 if has(rest[0]) else 1)
    elif what == 'note' and len(rest) == 1:
        note(rest[0])
    else:
        sys.exit(__doc__)


if __name__ == '__main__':
    main()
