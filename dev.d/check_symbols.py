#!/usr/bin/env python3
"""Symbol check of docs/determinism.md (D1): what the built engine calls.

check_symbols.py ARCHIVE...    lists each object that needs a function whose bits may differ between
                               machines; exit 1 if there is one
check_symbols.py --self-test   compiles planted faults and sees them found
"""
import os
import re
import subprocess
import sys
import tempfile

# sqrt is IEEE (an instruction, or at -O0 a call that rounds correctly), so it is not here.
LIBM = set('sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh sincos exp exp2 expm1 exp10 log log2 '
           'log10 log1p pow powi cbrt hypot erf erfc tgamma lgamma lgamma_r fma fmod remainder remquo floor ceil trunc '
           'round roundeven lround llround rint lrint llrint nearbyint fmin fmax fdim ldexp frexp scalbn '
           'scalbln modf ilogb logb drem gamma j0 j1 jn y0 y1 yn'.split())
LIBM |= {name + suffix for name in LIBM for suffix in 'fl'}
# Compiler helpers (complex and 128-bit floats, powi), variants of libm, standard random numbers.
PATTERNS = [
    (re.compile(r'^__(?:powi[sdtx]f2|mul[sdtx]c3|div[sdtx]c3)$'), 'compiler helper'),
    (re.compile(r'^__(?:\w+)_finite$|^_ZGV\w+_(?:sin|cos|exp|log|pow)f?$'), 'libm under -ffast-math'),
    (re.compile(r'random_device|mersenne_twister'), 'standard random number'),
    (re.compile(r'^(?:s?rand|random|drand48)$'), 'random number with state'),
    (re.compile(r'_Hash_bytes'), 'std::hash'),
    (re.compile(r'^fes?et(?:round|env)$'), 'floating-point environment'),
    (re.compile(r'^(?:strtod|strtof|strtold|atof)$'), 'reads numbers by the locale'),
]
# Objects that may need a symbol, each with its reason.
ALLOWED = {
    # nlohmann-json puts the locale's decimal point in before it calls strtod, which rounds correctly
    ('read_json.cpp.o', 'strtod'),
    ('write_json.cpp.o', 'strtod'),
}


def why(symbol):
    if symbol in LIBM:
        return 'libm'
    for pattern, reason in PATTERNS:
        if pattern.search(symbol):
            return reason
    return None


def undefined(path):
    """(object, symbol) of every undefined symbol of an archive or object."""
    run = subprocess.run(['nm', '-uA', path], capture_output=True, text=True, check=True)
    for line in run.stdout.splitlines():
        match = re.match(r'^(.*):\s+[Uwv] (\S+)$', line)
        if match:
            yield match.group(1), match.group(2).split('@')[0]


def check(paths):
    return sorted({(where, symbol, why(symbol)) for path in paths for where, symbol in undefined(path)
                   if why(symbol) and (where.split(':')[-1], symbol) not in ALLOWED})


PLANTED = {
    'double f(double x) { return __builtin_sin(x); }': 'sin',
    'float f(float x) { return __builtin_powf(x, x); }': 'powf',
    'double f(double x) { return __builtin_fma(x, x, x); }': 'fma',
    'double f(double x) { return __builtin_cbrt(x); }': 'cbrt',
    '#include <unordered_map>\n#include <string>\nint f(std::unordered_map<std::string, int>& m) { return m["a"]; }': 'Hash',
    '#include <random>\nunsigned f() { return std::random_device{}(); }': 'random_device',
    '#include <cstdlib>\nint f() { return rand(); }': 'rand',
}
CLEAN = '#include <cmath>\ndouble f(double x) { return std::sqrt(x) * 3 + x; }'


def self_test():
    compiler = os.environ.get('CXX', 'c++')

    def object_of(folder, source):
        path = os.path.join(folder, 'a.cpp')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(source)
        subprocess.run([compiler, '-O1', '-std=c++20', '-fno-math-errno', '-c', path, '-o', path + '.o'], check=True)
        return path + '.o'

    with tempfile.TemporaryDirectory() as folder:
        for source, symbol in PLANTED.items():
            found = check([object_of(folder, source)])
            if not any(symbol in name for _, name, _ in found):
                sys.exit(f'self-test: {symbol} not found in: {source}')
        found = check([object_of(folder, CLEAN)])
        if found:
            sys.exit(f'self-test: found where nothing is: {found}')
    print(f'self-test: {len(PLANTED)} planted faults found')


def main():
    if sys.argv[1:] == ['--self-test']:
        self_test()
        return
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    faults = check(sys.argv[1:])
    for where, symbol, reason in faults:
        print(f'{where}: error: needs {symbol} ({reason})')
    if faults:
        sys.exit(1)
    print(f'{len(sys.argv) - 1} archives call nothing whose bits differ between machines')


main()
