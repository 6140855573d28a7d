#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# The folder of plain C on an emulated Cortex-M4F, on aarch64 and on the host. Needs
# build/gearmap (./test.sh builds it) and, the first time, the network. Arguments are
# passed to pytest; GM_EMBEDDED_STEPS sets the steps of random tests (10000000 in CI).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/setup.sh

gm_install_packages gcc clang cppcheck python3 gcc-arm-none-eabi libnewlib-arm-none-eabi \
  qemu-system-arm qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross
gm_make_venv build/embedded tests/embedded/requirements.txt
export GEARMAP=$PWD/build/gearmap PYTHONDONTWRITEBYTECODE=1

gm_say "plain C on targets"
cd tests/embedded
../../build/embedded/bin/python -m pytest -q -rP -p no:cacheprovider "$@"
