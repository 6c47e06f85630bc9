# For transcripts: robots over Bluetooth LE that `orb ball` serves, and waits that have an end.

# until_true COMMAND...: comes back when the command succeeds.
until_true() {
  local try
  for ((try = 0; try < 2000; ++try)); do
    "$@" && return
    sleep 0.02
  done
  echo "$*: not even after 40 s"
  exit 1
}

# serve [PLAN [OPTION]]: a ball behind a Bluetooth LE of its own, which all further commands find; its port is $url.
serve() {
  local bus
  rm -f at
  orb ball --bluez${1:+=$1} ${2:-} >at &
  ball=$!
  until_true grep -qs BUS at
  read -r _ url bus <at
  export "$bus"
}

stop() { kill -TERM "$ball" && wait "$ball"; }
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT
