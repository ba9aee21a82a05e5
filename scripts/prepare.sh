# Sourced by the commands beside it: where the project lies, what it needs, how it is built.
# Debian's own tools come first: another python3 earlier in PATH breaks catkin and pluginlib.
export PATH=/usr/bin:/bin:$PATH
PROJECT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
COMMAND=$(basename "$0")
BUILD=$PROJECT/build
DEVEL=$PROJECT/devel

say() { printf '\033[1m[%s]\033[0m %s\n' "$COMMAND" "$*"; }
# A mistake of the caller: one line, exit code 2.
usage_error() { printf '%s: %s (see %s --help)\n' "$COMMAND" "$*" "$COMMAND" >&2; exit 2; }
fail() { printf '%s: %s\n' "$COMMAND" "$*" >&2; exit 1; }

# need_packages LIST...: installs what is missing of the lists, or says how and stops.
need_packages() {
  local wanted missing=() list
  for list in "$@"; do wanted+=" $(grep -v '^#' "$PROJECT/scripts/$list" | tr '\n' ' ')"; done
  command -v dpkg-query >/dev/null || fail "Debian 12's packages are needed, and this is no Debian (on ROS Noetic: rosdep install --from-paths . and catkin_make)"
  local have
  have=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' 2>/dev/null | sed -n 's/^ii  //p')
  for package in $wanted; do grep -qxF "$package" <<<"$have" || missing+=("$package"); done
  [ ${#missing[@]} -eq 0 ] && return 0
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      fail "${#missing[@]} packages are missing; as root run: apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
    fi
    root=(sudo)
  fi
  say "installing ${#missing[@]} Debian packages (once; up to 2 GB)"
  "${root[@]}" apt-get update -q || fail "apt-get update failed: is there a network?"
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    "${missing[@]}" || fail "apt-get could not install: ${missing[*]}"
}

# build WHAT [cmake options...]: WHAT is "run" (what a robot and an operator need) or "all" (tests
# and benchmarks too). A tree once configured for all stays so. Catkin snapshots the environment, so
# it is configured with nothing sourced.
build() {
  local what=$1; shift
  local options=(-DCMAKE_BUILD_TYPE=Release "$@")
  # What is built for all serves a run as well.
  if [ "$what" = run ] && grep -q '^all ' "$BUILD/.configured" 2>/dev/null; then what=all; fi
  if [ "$what" = all ]; then
    options+=(-DPILOTHOUSE_BENCH=ON -DCATKIN_ENABLE_TESTING=ON)
  elif [ ! -f "$BUILD/CMakeCache.txt" ]; then
    options+=(-DPILOTHOUSE_BENCH=OFF -DCATKIN_ENABLE_TESTING=OFF)
  fi
  local wanted="$what ${options[*]} $(sha256sum "$PROJECT/package.xml" | cut -c1-16)"
  if [ ! -f "$BUILD/build.ninja" ] || ! grep -qxF "$wanted" "$BUILD/.configured" 2>/dev/null; then
    say "configuring"
    unset ROS_PACKAGE_PATH CMAKE_PREFIX_PATH PYTHONPATH LD_LIBRARY_PATH PKG_CONFIG_PATH
    cmake -G Ninja -S "$PROJECT" -B "$BUILD" -DCATKIN_DEVEL_PREFIX="$DEVEL" "${options[@]}" \
      > "$PROJECT/build-configure.log" 2>&1 || {
        tail -n 30 "$PROJECT/build-configure.log" >&2; fail "cmake could not configure the project (build-configure.log has it all)"; }
    mv "$PROJECT/build-configure.log" "$BUILD/configure.log"
    echo "$wanted" > "$BUILD/.configured"
  fi
  say "building"
  NINJA_STATUS='[%f/%t, %e s] ' cmake --build "$BUILD" -j "$(nproc)" || fail "the build failed"
  if [ "$what" = all ]; then cmake --build "$BUILD" -j "$(nproc)" --target tests || fail "the tests do not build"; fi
}

# Makes the package known to this shell and keeps ROS's files inside the build tree.
use_ros() {
  # shellcheck disable=SC1091
  set +u; . "$DEVEL/setup.bash"; set -u
  export ROS_HOME=$BUILD/ros ROS_LOG_DIR=$BUILD/ros/log
  mkdir -p "$ROS_LOG_DIR"
}

# The real recordings beside the project, where they are.
use_data() {
  if [ -z "${PILOTHOUSE_DATA:-}" ] && [ -d "$PROJECT/../shared/data" ]; then
    PILOTHOUSE_DATA=$(cd "$PROJECT/../shared/data" && pwd)
  fi
  if [ -n "${PILOTHOUSE_DATA:-}" ]; then export PILOTHOUSE_DATA; else
    say "no recordings at ../shared/data: what needs them will be skipped (PILOTHOUSE_DATA names another folder)"; fi
}
