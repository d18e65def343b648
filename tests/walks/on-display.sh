#!/bin/sh
# Runs a program as on a screen of a user, by default a small one: on an X display of its own of FAINTLINE_WALK_SCREEN
# (1280x800) pixels, under a window manager, with a home of its own. on-display.sh PROGRAM [ARGUMENT …]; 77: something
# that it needs is not installed.
set -eu

for tool in Xvfb openbox xdotool; do
    command -v "$tool" >/dev/null || {
        echo "skipped: $tool is not installed"
        exit 77
    }
done

home=$(mktemp -d)
started=
stop() {
    # shellcheck disable=SC2086 # one word per process
    [ -z "$started" ] || kill $started 2>/dev/null || true
    wait || true
    rm -rf "$home"
}
trap stop EXIT
trap 'exit 143' HUP INT TERM

fail() {
    echo "error: on-display.sh: $1" >&2
    exit 1
}

# What is started here ends with this script, also where that is killed without a word.
start() {
    setpriv --pdeathsig TERM "$@" &
    started="$! $started"
}

export HOME="$home" XDG_CONFIG_HOME="$home/config" XDG_DATA_HOME="$home/data" XDG_CACHE_HOME="$home/cache"
mkdir -m 700 "$home/run" && export XDG_RUNTIME_DIR="$home/run"
start Xvfb -displayfd 1 -screen 0 "${FAINTLINE_WALK_SCREEN:-1280x800}x24" -nolisten tcp >"$home/display" 2>"$home/server.log"
server=$!
until [ -s "$home/display" ]; do
    kill -0 "$server" 2>/dev/null || fail "Xvfb does not start: $(tail -n 1 "$home/server.log")"
    sleep 0.1
done
DISPLAY=:$(cat "$home/display")
export DISPLAY

start openbox --sm-disable >"$home/manager.log" 2>&1
manager=$!
until xdotool get_num_desktops >/dev/null 2>&1; do
    kill -0 "$manager" 2>/dev/null || fail "openbox does not start: $(tail -n 1 "$home/manager.log")"
    sleep 0.1
done

start "$@"
program=$!
code=0
wait "$program" || code=$?
exit "$code"
