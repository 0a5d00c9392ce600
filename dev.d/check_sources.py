#!/usr/bin/env python3
"""Source check of docs/determinism.md (D1, D2): what must not stand in the engine's sources.

check_sources.py [ROOT]        prints file:line: message for every fault; exit 1 if there is one
check_sources.py --self-test   plants each fault once and sees it found

A line may keep a banned word when its comment says why it is harmless: `// D1: <reason>`.
"""
import pathlib
import re
import sys
import tempfile

LIBM = ('sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh sincos exp exp2 expm1 exp10 '
        'log log2 log10 log1p pow cbrt hypot erf erfc tgamma lgamma fma fmod remainder remquo '
        'floor ceil trunc round lround llround rint lrint llrint nearbyint fabs fmin fmax fdim '
        'ldexp frexp scalbn scalbln modf ilogb logb nextafter nexttoward lerp').split()
LIBM_WORDS = '|'.join(LIBM)

# (pattern, message). Comments and the contents of strings are blanked before matching.
ENGINE_RULES = [
    (rf'(?:\bstd::|(?<![\w.>:])::|(?<![\w.>:]))(?:{LIBM_WORDS})[fl]?\s*\(',
     'a libm function: its bits differ between machines; use engine/base/exact_math.h or clamp.h'),
    (rf'\bstd::(?:{LIBM_WORDS})[fl]?\b', 'a libm function, named'),
    (r'__builtin_(?:ia32_|fma|sin|cos|exp|log|pow)\w*', 'a compiler builtin with unknown rounding'),
    (r'#\s*include\s*<random>', '<random>: its distributions differ between libraries; use base/random.h'),
    (r'\bstd::(?:random_device|mt19937\w*|minstd_rand0?|default_random_engine|\w+_distribution)\b',
     'a standard random number; use base/random.h'),
    (r'\b(?:std::)?s?rand(?:om)?\s*\(', 'rand(): has state; use base/random.h'),
    (r'\bstd::hash\b', 'std::hash: differs between libraries'),
    (r'\bunordered_(?:multi)?(?:map|set)\b', 'an unordered container: its order differs; sort, or std::map'),
    (r'\batomic\s*<\s*(?:float|double|long double)\s*>', 'a floating-point atomic: sums in thread order'),
    (r'\batomic_ref\s*<\s*(?:float|double)\s*>', 'a floating-point atomic: sums in thread order'),
    (r'\bparallel_(?:reduce|scan|deterministic_reduce)\b|\bstd::(?:transform_)?reduce\s*\(|\bstd::execution\b',
     'a reduction whose order is not written down'),
    (r'\blong\s+double\b', 'long double differs between machines'),
    (r'#\s*pragma\s+(?:GCC\s+optimize|STDC\s+FP_CONTRACT|float_control|omp|clang\s+fp)\b',
     'a pragma that changes arithmetic'),
    (r'\b(?:MulAdd|MulSub|NegMulAdd|NegMulSub|MulAddSub)\s*\(', 'fused on some SIMD levels: write a * b + c'),
    (r'\bApproximateReciprocal\w*\s*\(', 'an approximation that differs between processors'),
    (r'\b(?:SumOfLanes|ReduceSum)\s*\(', 'a sum in lane order: its order depends on the SIMD level'),
    (r'_mm\d*_(?:\w*fn?m(?:add|sub)\w*|rsqrt\w*|rcp\w*)', 'fused or approximate instruction'),
    (r'\bstd::(?:sto[dfl]d?|strto[dfl]d?|atof)\b|(?<![\w.>:])(?:strto[dfl]d?|atof)\s*\(',
     'reads numbers by the locale; use std::from_chars'),
    (r'\bstd::chrono\b|#\s*include\s*<chrono>', 'a clock in the engine'),
    (r'\bfes?et(?:round|env|exceptflag)\s*\(', 'the floating-point environment is set in base/fpenv.h only'),
]
GLM_ALLOWED = re.compile(r'^(?:[diu]?vec[234]|dmat\d(?:x\d)?|mat\d(?:x\d)?|dot|cross|length_t)$')
GLM_HEADERS = re.compile(r'^glm/(?:(?:mat|vec)\d\w*|geometric|fwd)\.hpp$')
# A floating value in a cast: a literal with a point, a known double, a member of a vector.
FLOATING = (r'(?:\b\d+\.\d*(?:[eE]|\b)|\B\.\d+|\b(?:sqrt|Floor|Length|dot|exact::\w+|Between)\s*\('
            r'|\.[xyz]\b\s*[*/]|\bdouble\b|\bfloat\b)')
INTEGER_CAST = re.compile(
    r'static_cast<\s*(?:std::)?(?:unsigned(?:\s+\w+)?|(?:u?int(?:\d+|ptr)?(?:_t)?)|size_t|long(?:\s+long)?|short|char'
    r'|ptrdiff_t)\s*>\s*\(')

BUILD_RULES = [
    (r'-ffast-math|-Ofast|-march=native|-mtune=native|-ffp-contract=(?:fast|on)|-funsafe-math\w*'
     r'|-fassociative-math|-freciprocal-math|-ffinite-math-only|-mfma\b|-mrecip',
     'a compiler flag that changes pictures between builds'),
]
BUILD_EXEMPT = {'cmake/Determinism.cmake', 'dev.d/check_sources.py', 'dev.d/check_symbols.py'}


def blank_comments(text):
    """The text with comments and string contents replaced by spaces; lines keep their places."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'',
                         re.S)

    def blank(match):
        found = match.group(0)
        if found.startswith('"') and re.search(r'#\s*include\s*$', text[max(0, match.start() - 20):match.start()]):
            return found
        return re.sub(r'[^\n]', ' ', found)

    # 1'000'000 is no character.
    return pattern.sub(blank, re.sub(r"(?<=\d)'(?=\d)", '_', text))


def argument(text, start):
    """What stands between the bracket that opens before `start` and its partner."""
    depth, at = 1, start
    while at < len(text) and depth:
        depth += {'(': 1, ')': -1}.get(text[at], 0)
        at += 1
    return text[start:at - 1]


def check_engine_file(name, raw):
    faults = []
    code = blank_comments(raw)
    raw_lines = raw.split('\n')

    def report(position, message):
        line = code.count('\n', 0, position) + 1
        if re.search(r'//.*\bD1: \S', raw_lines[line - 1]):
            return
        faults.append((name, line, message))

    for pattern, message in ENGINE_RULES:
        if name == 'engine/base/fpenv.h' and 'environment' in message:
            continue
        for match in re.finditer(pattern, code):
            report(match.start(), f"'{match.group(0).strip()}': {message}")
    for match in re.finditer(r'\bglm::(\w+)', code):
        if not GLM_ALLOWED.match(match.group(1)):
            report(match.start(), f"'glm::{match.group(1)}': of GLM only types, + - *, dot and cross")
    for match in re.finditer(r'#\s*include\s*[<"](glm/[^>"]*)', code):
        if not GLM_HEADERS.match(match.group(1)):
            report(match.start(), f"'{match.group(1)}': of GLM only types, + - *, dot and cross")
    if name != 'engine/base/clamp.h':
        for match in INTEGER_CAST.finditer(code):
            inside = argument(code, match.end())
            if re.search(FLOATING, inside) and not re.search(r'\b(?:Clamp|Floor|Round)To\w+\s*\(', inside):
                report(match.start(), f"'{match.group(0)}{inside.strip()})': float to integer goes through base/clamp.h")
    return faults


def check_build_file(name, raw):
    faults = []
    for number, line in enumerate(raw.split('\n'), 1):
        for pattern, message in BUILD_RULES:
            match = re.search(pattern, line)
            if match:
                faults.append((name, number, f"'{match.group(0)}': {message}"))
    return faults


def check(root):
    root = pathlib.Path(root)
    faults, count = [], 0
    for path in sorted(root.glob('engine/**/*')):
        if path.suffix in ('.h', '.cpp'):
            count += 1
            faults += check_engine_file(path.relative_to(root).as_posix(), path.read_text('utf-8'))
    build = [root / 'CMakeLists.txt', root / 'CMakePresets.json', root / 'dev', *root.glob('cmake/*'),
             *root.glob('dev.d/*'), *root.glob('.ci/*')]
    for folder in ('engine', 'proto', 'server', 'worker', 'client', 'tests', 'bench'):
        build += root.glob(f'{folder}/**/CMakeLists.txt')
    for path in sorted(build):
        name = path.relative_to(root).as_posix()
        if path.is_file() and name not in BUILD_EXEMPT:
            faults += check_build_file(name, path.read_text('utf-8', 'replace'))
    return faults, count


BAD = r'''
double a = std::sin(x);
double a = floor(x);
double a = ::powf(x, y);
auto f = &std::exp;
#include <random>
std::uniform_real_distribution<double> u;
int r = rand();
std::hash<int> h;
std::unordered_map<int, int> m;
std::atomic<double> sum;
tbb::parallel_reduce(range, 0.0, f, g);
long double wide = 1;
#pragma GCC optimize("fast-math")
v = hn::MulAdd(a, b, c);
v = hn::ApproximateReciprocal(a);
s = hn::SumOfLanes(d, v);
double d = std::stod(text);
auto t = std::chrono::steady_clock::now();
std::fesetround(FE_UPWARD);
auto l = glm::length(v);
#include <glm/gtc/noise.hpp>
int i = static_cast<int>(x * 2.5);
uint32_t i = static_cast<uint32_t>(std::sqrt(x));
size_t i = static_cast<size_t>(p.x / cell);
double a = std::fma(b, c, d);
'''
GOOD = r'''
// std::sin(x) would differ here.
const char* text = "pow(x, y) and rand()";
double a = std::sqrt(x) + exact::Sin(y) + sampler.floor(x) + Round(x);
const Vec3 n = glm::cross(a, b) * glm::dot(a, b);
int i = ClampToInt32(x * 2.5) + static_cast<int>(vertices.size());
uint8_t q = static_cast<uint8_t>(RoundToUint32(v * 255.0, 255));
std::unordered_map<int, int> m;  // D1: looked up, never iterated
double width = 1'000'000.5;
double exponent = exp_table[3];
'''


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / 'engine/x').mkdir(parents=True)
        for line in BAD.strip().split('\n'):
            (root / 'engine/x/a.cpp').write_text(line + '\n')
            if not check(root)[0]:
                sys.exit(f'self-test: not found: {line}')
        (root / 'engine/x/a.cpp').write_text(GOOD)
        if check(root)[0]:
            sys.exit(f'self-test: found where nothing is: {check(root)[0]}')
        (root / 'engine/x/CMakeLists.txt').write_text('add_compile_options(-O3 -ffast-math)\n')
        if len(check(root)[0]) != 1:
            sys.exit('self-test: -ffast-math not found')
    print(f"self-test: {len(BAD.strip().splitlines()) + 1} planted faults found")


def main():
    if sys.argv[1:] == ['--self-test']:
        self_test()
        return
    root = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    faults, count = check(root)
    for name, line, message in faults:
        print(f'{name}:{line}: error: {message}')
    if count == 0:
        sys.exit(f'{root}: no engine sources here')
    if faults:
        sys.exit(1)
    print(f'{count} engine sources keep the rules of docs/determinism.md')


main()
