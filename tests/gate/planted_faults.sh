#!/usr/bin/env bash
# planted_faults.sh PROBE: the gate must fail, and say where, when a digest is another, when an item
# is missing, when one is new, and when the probe itself fails.
set -euo pipefail

probe=$1
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
compare=$root/dev.d/compare_digests.py
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "planted fault not found: $1" >&2
  exit 1
}
# must_fail WORD COMMAND...: exit 1, and WORD in what it says.
must_fail() {
  local word=$1 status=0
  shift
  "$@" >"$folder/said" 2>&1 || status=$?
  ((status == 1)) || fail "$* exits $status"
  grep -q -- "$word" "$folder/said" || fail "$* does not name $word"
}

"$probe" --only math/ >"$folder/good.txt"
python3 "$compare" --update "$folder/golden" "$folder/good.txt" >/dev/null
python3 "$compare" "$folder/golden" "$folder/good.txt" >/dev/null || fail 'equal lists called different'

# One bit of one digest.
sed -E '3 s/.$/x/' "$folder/good.txt" >"$folder/other.txt"
must_fail "$(sed -n '3 s/ .*//p' "$folder/good.txt")" python3 "$compare" "$folder/golden" "$folder/good.txt" "$folder/other.txt"
# An item less, an item more.
sed 1d "$folder/good.txt" >"$folder/less.txt"
must_fail 'less has none' python3 "$compare" "$folder/golden" "$folder/less.txt"
{ cat "$folder/good.txt" && echo 'math/new 00'; } >"$folder/more.txt"
must_fail 'math/new' python3 "$compare" "$folder/golden" "$folder/more.txt"
# An empty list proves nothing.
: >"$folder/empty"
must_fail 'empty' python3 "$compare" "$folder/empty" "$folder/good.txt"
# A scene that cannot be read.
mkdir "$folder/scenes"
echo 'objects {' >"$folder/scenes/bad.scene"
must_fail 'bad.scene' "$probe" --only scene/ --scenes "$folder/scenes"
# A level that is not there is a wrong command, not a pass.
status=0
"$probe" --simd mmx >/dev/null 2>&1 || status=$?
((status == 2)) || fail 'an unknown SIMD level'
status=0
FJORD_SIMD=mmx "$probe" --levels >/dev/null 2>&1 || status=$?
((status == 2)) || fail 'an unknown SIMD level in the environment'
[[ $(FJORD_SIMD=scalar "$probe" --only lanes/) == $("$probe" --only lanes/) ]] || fail 'FJORD_SIMD'
echo 'the gate finds 8 planted faults'
