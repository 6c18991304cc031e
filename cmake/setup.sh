# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# What validate/run.sh and tests/run.sh share: options, packages and builds. Sourced with $root set
# to the project's folder and a function `usage`; takes its own options from the arguments and leaves
# the others. Results go to stdout; all that is said here goes to stderr.
: "${root:?}"

say() {
  printf '%s\n' "$*" >&2
}

die() {
  say "$(basename -- "$0"): $*"
  exit 2
}

# With $test_packages set to yes, those that tests alone need too.
print_packages() {
  set -- "$root/cmake/packages.txt"
  [ "${test_packages:-no}" = no ] || set -- "$@" "$root/cmake/packages-test.txt"
  sed -e 's/[[:space:]]*#.*//' -e '/^[[:space:]]*$/d' "$@"
}

# The packages of the list that are not installed, on one line.
missing_packages() {
  for package in $(print_packages); do
    case $(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null) in
    ii*) ;;
    *) printf '%s ' "$package" ;;
    esac
  done
}

# Runs a command as root and asks nothing.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo -n "$@"
  fi
}

install_packages() {
  command -v dpkg-query >/dev/null 2>&1 ||
    die "not a Debian system: install what $root/cmake/packages.txt names, then use --no-install"
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0
  hint="install by hand: apt-get install $missing"
  command -v apt-get >/dev/null 2>&1 || die "no apt-get; $hint"
  as_root true 2>/dev/null || die "neither root nor sudo without a password; $hint"
  say "Installing Debian packages: $missing"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2 ||
    die "apt-get update failed; $hint"
  # shellcheck disable=SC2086 # a list of names
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends $missing >&2 || die "apt-get failed; $hint"
}

# build PRESET: configures and builds into build/PRESET. The log is shown only if it fails.
build() {
  mkdir -p "$root/build" || die "$root/build cannot be made"
  log=$root/build/$1.log
  say "Building build/$1 ..."
  if ! (cd -- "$root" && cmake --preset "$1" && cmake --build --preset "$1") >"$log" 2>&1; then
    cat -- "$log" >&2
    die "the build failed; its log is $log"
  fi
}

install=yes
count=$#
while [ "$count" -gt 0 ]; do
  argument=$1
  shift
  count=$((count - 1))
  case $argument in
  --print-packages) print_packages && exit 0 ;;
  --no-install) install=no ;;
  --help) usage && exit 0 ;;
  *) set -- "$@" "$argument" ;;
  esac
done
[ "$install" = no ] || install_packages
