# Shared by cases/quickstart and tests/run: installs what is missing with apt-get (Debian 12), configures and builds the release.
# To be sourced with the current folder at the root of the sources. `build` is the build folder, `cmake_options` what
# the caller adds to the configuration.

packages=(g++ cmake ninja-build pkg-config libboost-dev libeigen3-dev liburdfdom-dev libtinyxml-dev libassimp-dev libosmesa6-dev
  nlohmann-json3-dev libcli11-dev libdime-dev libocct-data-exchange-dev libfmt-dev libhdf5-dev libfreetype-dev libpng-dev zlib1g-dev
  libavcodec-dev libavformat-dev libavutil-dev libswscale-dev libsuitesparse-dev libopenblas-serial-dev fonts-dejavu-core libjs-three)
test_packages=(libgtest-dev libbenchmark-dev libgmp-dev libcgal-dev python3)
build=build/release
cmake_options=()

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "This needs root: install sudo, or run as root: $*" >&2
    return 1
  fi
}

# apt_get WORD...: apt-get as root, waiting up to ten minutes (apt_wait_s seconds) for another one that runs. Its own option waits for the
# lock of packages alone; for that of the lists it is asked again.
apt_wait_s=600
apt_get() {
  local said status until=$((SECONDS + apt_wait_s))
  said=$(mktemp)
  while true; do
    status=0
    as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -o DPkg::Lock::Timeout="$apt_wait_s" -q "$@" 2>"$said" || status=$?
    cat "$said" >&2
    if [ "$status" -eq 0 ] || [ "$SECONDS" -ge "$until" ] || ! grep -q 'Could not get lock\|Unable to lock' "$said"; then break; fi
    echo "Another apt is running: waiting for it" >&2
    sleep "${apt_pause_s:-5}"
  done
  rm -f "$said"
  return "$status"
}

# install_packages NAME...: those of them that are not there yet.
install_packages() {
  local missing=() name
  for name in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$name" 2>/dev/null | grep -qx installed || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if ! command -v apt-get >/dev/null; then
    echo "These packages are missing, and there is no apt-get to install them with: ${missing[*]}" >&2
    return 1
  fi
  echo "Installing: ${missing[*]}"
  apt_get update
  apt_get install -y --no-install-recommends "${missing[@]}"
}

# build_release [TARGET...]: configures and builds, everything where no target is named. As many compilers at once as there are
# cores, but no more than one for each 1.5 GB of memory.
build_release() {
  local jobs memory_kb by_memory
  jobs=$(nproc)
  memory_kb=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
  by_memory=$((memory_kb / 1500000))
  [ "$by_memory" -ge 1 ] || by_memory=1
  [ "$jobs" -le "$by_memory" ] || jobs=$by_memory
  # Where all is to be built, sources are joined; a build folder that is there stays as it is.
  [ -e "$build/CMakeCache.txt" ] || cmake_options+=(-DGAMBESON_JOINED=ON)
  cmake --preset release "${cmake_options[@]}"
  if [ $# -gt 0 ]; then
    cmake --build "$build" --parallel "$jobs" --target "$@"
  else
    cmake --build "$build" --parallel "$jobs"
  fi
}
