#!/usr/bin/env bash
# sanitize.sh [--short] [--only asan|tsan] [--work FOLDER] [-- CTEST-ARGUMENT...]
# The tests and the examples under the address and undefined-behaviour sanitizers (asan), then under
# the thread sanitizer (tsan). The first finding of a program ends it, and so fails its test.
#   --short   only the tests that reach most of the code in little time, without the examples, and
#             only where something has changed since they were green (green.py)
#   --work    where to build (default build)
# Exit 0 clean, 1 a finding or a build that fails.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(dirname -- "$here")
form=full work=$root/build only=''
while (($#)); do
  case $1 in
    --short) form=short ;;
    --only) only=$2 && shift ;;
    --work) work=$2 && shift ;;
    --) shift && break ;;
    *) sed -n '2,8p' "${BASH_SOURCE[0]}" >&2 && exit 2 ;;
  esac
  shift
done
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root}
# A test may put a library of its own before the sanitizer's.
export ASAN_OPTIONS=halt_on_error=1:detect_stack_use_after_return=1:verify_asan_link_order=0
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$here/tsan.supp
say() { printf '%s\n' "$*" >&2; }

# The short form's programs and tests. Threads: parallel loops, tiles, the worker, the coordinator.
short_targets() {
  case $1 in
    asan) echo fjord_{base,geometry,formats,fractal_curve,fractal_coast,render,animation,farm}_test ;;
    tsan) echo fjord_{base,render,farm}_test ;;
  esac
}
short_tests() {
  case $1 in
    asan) echo '^(base|geometry|formats|fractal_curve|fractal_coast|render|animation|farm)\.' ;;
    tsan) echo '^(base\.Parallel|render\..*(Invarian|Threads|Cache)|farm\.(Retry|Held|Worker|ChildRenderer))' ;;
  esac
}
# What is about files, compilers or speed, and not about memory or threads.
readonly kElsewhere='^(Lint|Gate|Sanitize)\.|CostsLittle|MemoryFollows|BoundedMemory'

build() {
  local preset=$1 log=$work/$1.log start=$SECONDS
  shift
  mkdir -p "$work"
  if ! { cmake -S "$root" --preset "$preset" -B "$work/$preset" && ninja -C "$work/$preset" "$@"; } >"$log" 2>&1; then
    grep -E -A 8 -m 5 'error|FAILED' "$log" >&2 || tail -n 30 "$log" >&2
    say "sanitize: $preset could not be built; all of it is in $log"
    exit 1
  fi
  say "built $preset in $((SECONDS - start)) s"
}

# Each example, small, its first, middle and last frame.
examples() {
  local fjord=$work/$1/client/fjord out=$work/$1/examples scene
  rm -rf "$out"
  for scene in "$root"/examples/*.scene "$root"/examples/*/*.scene; do
    [[ -f $scene ]] || continue
    say "  $1: ${scene#"$root"/}"
    "$fjord" check "$scene" >/dev/null
    "$fjord" render "$scene" -o "$out/$(basename "$scene" .scene)" --size 192x108 --threads 2 --frames 1 >/dev/null
  done
}

look() {
  local preset=$1
  shift
  [[ -z $only || $only == "$preset" ]] || return 0
  if [[ $form == short ]]; then
    local targets
    read -ra targets < <(short_targets "$preset")
    build "$preset" "${targets[@]}"
    ctest --test-dir "$work/$preset" -j2 --output-on-failure --no-tests=error -R "$(short_tests "$preset")" \
      -E "$kElsewhere" "$@"
    return
  fi
  build "$preset"
  ctest --test-dir "$work/$preset" -j2 --output-on-failure --no-tests=error -E "$kElsewhere" "$@"
  examples "$preset"
}

key=''
if [[ $form == short ]]; then
  key=$(python3 "$here/green.py" key sanitize "$only" "$(g++ --version)" "$*" -- "$root/CMakeLists.txt" \
    "$root/CMakePresets.json" "$root"/{cmake,engine,proto,server,worker,client,tests,examples} \
    "$here/sanitize.sh" "$here/tsan.supp")
  if python3 "$here/green.py" has "$key"; then
    say 'sanitize: nothing has changed since it was green'
    exit 0
  fi
fi
look asan "$@"
look tsan "$@"
[[ -z $key ]] || python3 "$here/green.py" note "$key"
say 'sanitize: clean'
