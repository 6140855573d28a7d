#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# From a bare Debian or Ubuntu machine to a simulated FMU: installs what is missing,
# builds, reduces the 7-speed dual-clutch example, simulates it, and drives a car over a
# cycle with the detailed and with the reduced gearset to compare them, and explains it all
# on an HTML page.
set -euo pipefail
cd "$(dirname "$0")"
. tools/setup.sh
start=$SECONDS

gm_install_packages "${gm_build_packages[@]}"
gm_make_venv build/venv tools/requirements.txt tools/report/requirements.txt
gm_build build -DCMAKE_BUILD_TYPE=Release -DGM_BUILD_TESTS=OFF -DGM_BUILD_BENCH=OFF \
  -DGM_PYTHON="$PWD/build/venv/bin/python"

gm_say "reducing examples/dct7.yaml"
# also drives a car over ECE-15 with both gearsets, for the FMU's accuracy passport
build/gearmap reduce examples/dct7.yaml -o build/dct7.fmu --map build/dct7.map \
  --cycle ece15 --trace build/drive.csv >build/dct7.txt
sed '/^cycle /,$d' build/dct7.txt

gm_say "simulating build/dct7.fmu"
build/venv/bin/python examples/simulate.py build/dct7.fmu build/dct7.csv

gm_say "a car on ECE-15 with the detailed and the reduced gearset"
sed -n '/^cycle /,$p' build/dct7.txt

gm_say "explaining it on a page"
build/gearmap report build/dct7.map build/drive.csv -o build/dct7.html

gm_say "done in $((SECONDS - start)) s: build/dct7.fmu, build/dct7.map, build/dct7.html"
