# What tools/run and tools/test share; read by them, not run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
tool=tools/$(basename "$0")

fail() {
  echo "$tool: $1" >&2
  exit "${2:-1}"
}

# Only one at a time may configure and build in a folder; the others wait.
lock() {
  mkdir -p "$1" 2>/dev/null || fail "cannot write to $1; check who owns the checkout."
  { exec 9>"$1/.lock"; } 2>/dev/null || fail "cannot write to $1; check who owns the checkout."
  flock -n 9 || { echo "$tool: waiting for another build in $1"; flock 9; }
}

unlock() {
  exec 9>&-
}

# configure FOLDER [cmake options]: where that has not been done, or with other options. (Ninja
# configures again by itself when a CMakeLists.txt has changed.)
configure() {
  local folder=$1 options="${*:2}"
  [[ -f $folder/build.ninja && $(cat "$folder/.options" 2>/dev/null) == "$options" ]] && return
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  cmake -S "$root" -B "$folder" -G Ninja "${launcher[@]}" "${@:2}" ||
    fail "configuring failed; the reason stands above. If $folder comes from elsewhere, remove it and try again."
  echo "$options" >"$folder/.options"
}

# build FOLDER [targets]: says nothing where nothing is to be done.
build() {
  local folder=$1
  if ninja -C "$folder" -n "${@:2}" 2>/dev/null | grep -q '^ninja: no work to do'; then return; fi
  ninja -C "$folder" "${@:2}" || fail "building failed; the reason stands above."
}
