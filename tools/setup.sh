# SPDX-License-Identifier: BSD-2-Clause
# Sourced by quickstart.sh, test.sh and .ci/run: installs what is missing and builds.
# A second run finds everything in place and works without a network.
# Words go to the standard error, results of what is called to the standard output.

gm_build_packages=(
  cmake ninja-build gcc libc6-dev pkg-config python3 python3-venv
  libsundials-dev libsuitesparse-dev libfyaml-dev libsqlite3-dev libxml2-dev libzip-dev
  libjansson-dev libmd-dev)
# make and g++: fmpy compiles the sources of an FMU through a CMake project of its own
gm_test_packages=(libcmocka-dev binutils make g++)

gm_say() {
  printf '%s\n' "== $*" >&2
}

gm_is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

gm_as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    gm_say "installing packages needs root or sudo: $*"
    return 1
  fi
}

# gm_install_packages NAME...: installs those that are missing.
gm_install_packages() {
  local missing=() name
  if ! command -v apt-get >/dev/null; then
    gm_say "no apt-get here; these packages or their like must be installed: $*"
    return 0
  fi
  for name in "$@"; do
    gm_is_installed "$name" || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  gm_say "installing ${missing[*]}"
  gm_as_root apt-get update -qq >&2
  gm_as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends -o Dpkg::Use-Pty=0 "${missing[@]}" >&2 </dev/null
}

# gm_make_venv FOLDER REQUIREMENTS...: a Python environment with the packages listed.
gm_make_venv() {
  local venv=$1 wanted python=/usr/bin/python3
  shift
  wanted=$(cat "$@")
  [ "$(cat "$venv/requirements.txt" 2>/dev/null)" != "$wanted" ] || return 0
  [ -x "$python" ] || python=python3
  gm_say "installing Python packages into $venv"
  "$python" -m venv "$venv" >&2
  printf '%s\n' "$wanted" >"$venv/requirements.new"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check \
    -r "$venv/requirements.new" >&2 </dev/null
  mv "$venv/requirements.new" "$venv/requirements.txt"
}

# gm_build FOLDER OPTION...: configure and build.
gm_build() {
  local folder=$1
  shift
  gm_say "building in $folder"
  cmake -S . -B "$folder" -G Ninja "$@" >"$folder.log" 2>&1 || {
    cat "$folder.log" >&2
    return 1
  }
  cmake --build "$folder" >>"$folder.log" 2>&1 || {
    cat "$folder.log" >&2
    return 1
  }
  mv "$folder.log" "$folder/build.log"
}
