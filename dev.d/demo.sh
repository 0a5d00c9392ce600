#!/usr/bin/env bash
# ./dev demo: a farm of one coordinator and two workers on this machine renders the demo scene.
# Called with the root of the tree; $FJORD is the program.
set -euo pipefail

root=$1
scene=$root/examples/taiwan-rising.scene
out=$root/out/taiwan-rising
data=$root/out/.farm
farm_log=$data/farm.log
farm=

stop() {
  trap '' INT TERM HUP
  if [[ -n $farm ]]; then
    kill -TERM "$farm" 2>/dev/null || true
    wait "$farm" 2>/dev/null || true
  fi
}
trap stop EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

mkdir -p "$out" "$data"
: >"$farm_log"
: >"$data/address"  # here: the farm's own redirection comes after we have begun to look
# In its own session, so that Ctrl-C reaches this script first, which then stops it in order.
setsid "$FJORD" farm --workers 2 --data "$data" --listen 127.0.0.1:0 --with-parent >"$data/address" 2>>"$farm_log" </dev/null &
farm=$!
address=
for ((i = 0; i < 300 && ${#address} == 0; i++)); do
  kill -0 "$farm" 2>/dev/null || break
  address=$(sed -n 's/^listening on //p' "$data/address")
  [[ -n $address ]] || sleep .1
done
if [[ -z $address ]]; then
  tail -n 5 "$farm_log" >&2
  echo "demo: error: the farm did not start; its log is $farm_log" >&2
  exit 1
fi

export FJORD_SERVER=$address
echo "a farm of one coordinator and two workers listens on $address (log: $farm_log)" >&2
job=$("$FJORD" submit "$scene" --project demo)
"$FJORD" watch "$job"
"$FJORD" fetch "$job" -o "$out" --replace
"$FJORD" movie "$out" -o "$out/taiwan-rising.mp4"
"$FJORD" sheet "$out" -o "$out/contact-sheet.png" --columns 8
cat <<DONE

frames         $out/taiwan-rising.0001.png ... taiwan-rising.0096.png
movie          $out/taiwan-rising.mp4
contact sheet  $out/contact-sheet.png
DONE
