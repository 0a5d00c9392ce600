#!/usr/bin/env bash
# lint.sh [format|sources|symbols|tidy|tidy-all|self-test|changed|--all] [BUILD]
# The checks behind `./dev lint` and the Lint.* tests. BUILD (default build/release) is a configured
# build folder; `symbols` and `tidy` read it. `changed` (the default) is every check, but clang-tidy
# passes over what has not changed since it was green; `--all` looks at everything anew.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
root=$(dirname -- "$here")
what=${1:-changed}
build=${2:-$root/build/release}

# Every C++ file of the project, from git or, in an unpacked archive, from the folders.
cpp_files() {
  cd -- "$root"
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files -z -- '*.h' '*.cpp' | while IFS= read -r -d '' file; do
      [[ -f $file ]] && printf '%s\0' "$file"
    done
  else
    find engine server worker client tests bench \( -name '*.h' -o -name '*.cpp' \) -print0
  fi
}

check_format() {
  cd -- "$root"
  local style
  style=$(mktemp)
  if ! cpp_files | xargs -0 clang-format --dry-run -Werror 2>"$style"; then
    grep -E 'error:' "$style" | head -n 40 || cat "$style"
    echo "format: $(grep -c 'error:' "$style") places are not in the house format; run ./dev format" >&2
    rm -f "$style"
    return 1
  fi
  rm -f "$style"
  echo "format: $(cpp_files | tr -cd '\0' | wc -c) files are in the house format"
}

# The archives that a picture goes through; image_io only carries finished samples.
check_symbols() {
  local archives=() name
  for name in base geometry knobs formats fractal texture scene animation image render; do
    archives+=("$build/engine/$name/libfjord_$name.a")
  done
  python3 "$here/check_symbols.py" "${archives[@]}"
}

# Each check must see a planted fault.
self_test() {
  python3 "$here/check_sources.py" --self-test
  python3 "$here/check_symbols.py" --self-test
  python3 "$here/green.py" --self-test
  local folder
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' RETURN
  cp "$root/.clang-format" "$root/.clang-tidy" "$folder"
  printf 'int  f( int x ){return x ;}\n' >"$folder/a.cpp"
  if clang-format --dry-run -Werror "$folder/a.cpp" 2>/dev/null; then
    echo "self-test: clang-format found nothing wrong" >&2
    return 1
  fi
  printf '#include <string>\n#include <utility>\nbool f(std::string a) {\n  std::string b = std::move(a);\n  return a.empty() == b.empty();\n}\n' >"$folder/a.cpp"
  if clang-tidy --quiet "$folder/a.cpp" -- -std=c++20 >/dev/null 2>&1; then
    echo "self-test: clang-tidy found nothing wrong" >&2
    return 1
  fi
  echo "self-test: clang-format and clang-tidy find planted faults"
}

case $what in
  format) check_format ;;
  sources) python3 "$here/check_sources.py" "$root" ;;
  symbols) check_symbols ;;
  tidy) python3 "$here/tidy.py" "$build" ;;
  tidy-all) python3 "$here/tidy.py" "$build" --all ;;
  self-test) self_test ;;
  changed | --all)
    status=0 anew=()
    [[ $what == --all ]] && anew=(--anew)
    check_format || status=1
    python3 "$here/check_sources.py" "$root" || status=1
    check_symbols || status=1
    python3 "$here/tidy.py" "$build" --all "${anew[@]}" || status=1
    exit $status
    ;;
  *)
    sed -n '2,5p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
