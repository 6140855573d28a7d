#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# The FMUs of the examples in validators and importers made by others. Needs build/gearmap
# (./test.sh builds it) and, the first time, the network. Arguments are passed to pytest.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/setup.sh
fmi_sim_version=0.7.0

# fmi-sim's dependencies need Rust 1.85. Debian 12 has 1.63 as cargo, and a newer one as
# cargo-web, which it keeps for its browsers.
install_rust() {
  local version
  version=$(cargo --version 2>/dev/null | cut -d' ' -f2)
  if [ "$(printf '%s\n' 1.85 "$version" | sort -V | head -n1)" = 1.85 ]; then
    return 0
  fi
  if [ -n "$(apt-cache policy cargo-web 2>/dev/null)" ]; then
    gm_install_packages cargo-web
  else
    gm_install_packages cargo
  fi
}

# Prints where fmi-sim is; builds it when it is neither in the path nor in build/.
find_fmi_sim() {
  local root=$PWD/build/fmi-sim
  if fmi-sim --version 2>&1 | grep -q "fmi-sim $fmi_sim_version"; then # as an error
    command -v fmi-sim
    return 0
  fi
  if [ ! -x "$root/bin/fmi-sim" ]; then
    gm_install_packages clang libclang-dev # for the bindings of the FMI headers
    install_rust
    gm_say "building fmi-sim $fmi_sim_version"
    cargo install --quiet fmi-sim --locked --version "$fmi_sim_version" --debug \
      --root "$root" --target-dir "$root/target" >&2 </dev/null
    rm -rf "$root/target"
  fi
  printf '%s\n' "$root/bin/fmi-sim"
}

gm_install_packages libxml2-utils libtbb12 cmake make gcc g++ # libtbb12: for ecospy
gm_make_venv build/importers tests/importers/requirements.txt
GM_FMI_SIM=$(find_fmi_sim)
export GM_FMI_SIM GM_SOURCE_DIR=$PWD GEARMAP=$PWD/build/gearmap PYTHONDONTWRITEBYTECODE=1

gm_say "importers"
cd tests/importers
../../build/importers/bin/python -m pytest -q -p no:cacheprovider "$@"
