#!/usr/bin/env bash
# The exactness gate (docs/determinism.md): builds fjord_probe by several compilers and for several
# processors, runs it with several SIMD levels, thread counts, tile sizes and orders, and compares
# every digest with tests/gate/golden.txt.
#
# portability.sh [--short|--full|--update] [--probe PROGRAM] [--work FOLDER] [--native|--cross]
#   --short   the given probe (or g++ -O3), clang -O2, aarch64; a few runs each
#   --full    (g++, clang) x (-O0, -O2, -O3), aarch64 and s390x, every run (the default)
#   --update  as --short without comparing; writes the golden list if all agree
#   --probe   a probe already built, in place of the short form's g++ build
#   --work    where to build (default build/gate)
#   --native, --cross   only this processor's builds, or only the others'
#   --only WORD         only the builds whose names hold WORD: clang, s390x, arm64-O3 ...
# The short form passes over builds and runs of which nothing has changed since they were green: no
# source, scene, golden digest, compiler, library or SIMD level (green.py). The full one never does.
# Exit 0 equal, 1 different or not buildable, 77 with --cross alone where the foreign libraries cannot
# be had (no network).
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(dirname -- "$here")
form=full work=$root/build/gate probe='' native=1 cross=1 only=''
while (($#)); do
  case $1 in
    --short | --full | --update) form=${1#--} ;;
    --probe) probe=$2 && shift ;;
    --work) work=$2 && shift ;;
    --only) only=$2 && shift ;;
    --native) cross=0 ;;
    --cross) native=0 ;;
    *) sed -n '2,18p' "${BASH_SOURCE[0]}" >&2 && exit 2 ;;
  esac
  shift
done
mkdir -p "$work"
work=$(cd -- "$work" && pwd -P)
out=$work/out
rm -rf "$out"
mkdir -p "$out"
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root}
jobs=$(nproc)
unset FJORD_SIMD

wanted() { [[ $1 == *"$only"* ]]; }
say() { printf '%s\n' "$*" >&2; }

# What the digests depend on, and how this form looks at it.
green_key() {
  local tools
  tools=$(for tool in g++ clang++ aarch64-linux-gnu-g++ qemu-aarch64-static; do
    "$tool" --version 2>/dev/null | head -n 1 || true
  done
  dpkg-query -W libprotobuf-dev libhwy-dev libtbb-dev libglm-dev libssl-dev nlohmann-json3-dev \
    libexpat1-dev 2>/dev/null || true)
  [[ -z $probe ]] || tools+=$("$probe" --levels)$(sha256sum <"$probe")
  python3 "$here/green.py" key gate "$form" "$native" "$cross" "$only" "$tools" -- \
    "$root/CMakeLists.txt" "$root/cmake" "$root/engine" "$root/proto" "$root/tests/CMakeLists.txt" \
    "$root/tests/gate" "$root/examples" "$here/portability.sh" "$here/compare_digests.py" "$here/cross.cmake"
}
key=''
if [[ $form == short ]]; then
  key=$(green_key)
  if python3 "$here/green.py" has "$key"; then
    say 'gate: nothing has changed since it was green'
    exit 0
  fi
fi

# build NAME CMAKE-ARGUMENT...: leaves $work/NAME/tests/gate/fjord_probe.
build() {
  local name=$1 log=$work/$1.log start=$SECONDS
  shift
  if ! { cmake -S "$root" -B "$work/$name" -G Ninja -DFJORD_ENGINE_ONLY=ON -DCMAKE_BUILD_TYPE=Release "$@" &&
    ninja -C "$work/$name" -j "$jobs" fjord_probe; } >"$log" 2>&1; then
    grep -E -A 8 'error|Error|FAILED' "$log" | head -n 40 >&2 || tail -n 30 "$log" >&2
    say "gate: $name could not be built; all of it is in $log"
    exit 1
  fi
  say "built $name in $((SECONDS - start)) s"
}

# run NAME COMMAND...: one run, its lines in out/NAME.txt.
run() {
  local name=$1 start=$SECONDS
  shift
  if ! "$@" >"$out/$name.txt" 2>"$out/$name.err"; then
    say "gate: $name failed:"
    head -n 20 "$out/$name.err" >&2
    exit 1
  fi
  say "  ran $name in $((SECONDS - start)) s"
}

# runs NAME COMMAND...: what this form asks of one program.
runs() {
  local name=$1 level levels
  shift
  mapfile -t levels < <("$@" --levels)
  local weakest=${levels[0]} best=${levels[-1]}
  if [[ $form != full ]]; then
    run "$name-$best" "$@" --simd "$best"
    run "$name-$weakest-7-threads-shuffled" "$@" --simd "$weakest" --threads 7 --tile 32 --patch 300 --shuffle
    return
  fi
  for level in "${levels[@]}"; do
    run "$name-$level" "$@" --simd "$level"
    run "$name-$level-2-threads-tile-64" "$@" --simd "$level" --threads 2 --tile 64 --patch 64
    run "$name-$level-7-threads-tile-16-shuffled" "$@" --simd "$level" --threads 7 --tile 16 --patch 4096 --shuffle
  done
}

# sysroot ARCHITECTURE TRIPLE: Debian's libraries of another processor in $work/sysroot-ARCHITECTURE,
# by an apt of its own: no root is needed, and the machine's list of architectures stays as it is.
sysroot() {
  local arch=$1 triple=$2 dir=$work/sysroot-$1 apt=$work/apt-$1
  local packages=(libprotobuf-dev libprotobuf32 zlib1g zlib1g-dev libssl-dev libssl3 libtbb-dev libtbb12
    libtbbmalloc2 libtbbbind-2-5 libhwy-dev libhwy1 libglm-dev nlohmann-json3-dev libexpat1-dev libexpat1)
  [[ -f $dir/complete && $(<"$dir/complete") == "${packages[*]}" ]] && return 0
  rm -rf "$dir" "$apt"
  mkdir -p "$dir" "$apt/lists/partial" "$apt/archives/partial" "$apt/debs"
  : >"$apt/status"
  local options=(-q -o "APT::Architecture=$arch" -o "APT::Architectures=$arch"
    -o "Dir::State::lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt"
    -o APT::Sandbox::User= -o Acquire::Languages=none -o Debug::NoLocking=1)
  if ! { apt-get "${options[@]}" update &&
    (cd "$apt/debs" && apt-get "${options[@]}" download "${packages[@]}"); } >"$apt/log" 2>&1; then
    tail -n 5 "$apt/log" >&2
    say "gate: Debian's $arch libraries cannot be fetched; all of it is in $apt/log"
    return 1
  fi
  local deb
  for deb in "$apt"/debs/*.deb; do
    dpkg-deb -x "$deb" "$dir"
  done
  # Some packages still unpack into /lib: one place for all.
  if [[ -d $dir/lib ]]; then
    cp -a "$dir/lib/." "$dir/usr/lib/"
    rm -rf "$dir/lib"
  fi
  # A link that is absolute in a package would lead out of this folder.
  local link target
  while IFS= read -r link; do
    target=$(readlink -- "$link")
    ln -sfn "$dir/usr${target#/usr}" "$link"
  done < <(find "$dir/usr/lib" -type l -lname '/*')
  rm -rf "$apt"
  printf '%s' "${packages[*]}" >"$dir/complete"
}

# foreign ARCHITECTURE TRIPLE QEMU OPTIMISATION
foreign() {
  local arch=$1 triple=$2 qemu=$3 level=$4 dir=$work/sysroot-$1
  wanted "$arch-$level" || return 0
  if ! command -v "$triple-g++" >/dev/null || ! command -v "$qemu" >/dev/null; then
    say "gate: $triple-g++ or $qemu is missing: apt-get install g++-$triple qemu-user-static"
    exit 1
  fi
  if ! sysroot "$arch" "$triple"; then
    ((native)) && exit 1
    exit 77
  fi
  build "$arch-$level" -DCMAKE_TOOLCHAIN_FILE="$here/cross.cmake" -DFJORD_CROSS="$triple" \
    -DFJORD_SYSROOT="$dir" -DCMAKE_CXX_FLAGS_RELEASE="-$level"
  runs "$arch-$level" "$qemu" -L "/usr/$triple" -E "LD_LIBRARY_PATH=$dir/usr/lib/$triple" \
    "$work/$arch-$level/tests/gate/fjord_probe"
}

if ((native)); then
  if [[ $form == full ]]; then
    for level in O3 O2 O0; do
      for compiler in g++ clang++; do
        wanted "$compiler-$level" || continue
        build "$compiler-$level" -DCMAKE_CXX_COMPILER=$compiler -DCMAKE_CXX_FLAGS_RELEASE="-$level"
        runs "$compiler-$level" "$work/$compiler-$level/tests/gate/fjord_probe"
      done
    done
  else
    if [[ -z $probe ]]; then
      build g++-O3 -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS_RELEASE=-O3
      probe=$work/g++-O3/tests/gate/fjord_probe
    fi
    runs native "$probe"
    # Two SIMD levels: a third of the time to compile.
    build clang-O2 -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS_RELEASE=-O2 \
      '-DFJORD_SIMD_WITHOUT=|HWY_SSSE3|HWY_SSE4|HWY_AVX3'
    runs clang-O2 "$work/clang-O2/tests/gate/fjord_probe"
  fi
fi
if ((cross)); then
  foreign arm64 aarch64-linux-gnu qemu-aarch64-static O2
  if [[ $form == full ]]; then
    foreign arm64 aarch64-linux-gnu qemu-aarch64-static O3
    foreign s390x s390x-linux-gnu qemu-s390x-static O2
  fi
fi
if [[ $form == update ]]; then
  python3 "$here/compare_digests.py" --update "$root/tests/gate/golden.txt" "$out"/*.txt
else
  python3 "$here/compare_digests.py" "$root/tests/gate/golden.txt" "$out"/*.txt
fi
[[ -z $key ]] || python3 "$here/green.py" note "$key"
