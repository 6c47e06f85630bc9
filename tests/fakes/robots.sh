# For transcripts: virtual robots over Bluetooth LE, and waits with a limit.

# until_true COMMAND...: waits until the command succeeds.
until_true() {
  local try
  for ((try = 0; try < 2000; ++try)); do
    "$@" && return
    sleep 0.02
  done
  echo "$*: not even after 40 s"
  exit 1
}

# serve [PLAN [OPTION]]: serves a ball behind its own Bluetooth LE, which all later commands use; its port is $url.
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
