#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Installs what is missing, builds with warnings as errors, runs every test.
# Arguments are passed to ctest (for one test: ./test.sh -R test_json).
set -euo pipefail
cd "$(dirname "$0")"
. tools/setup.sh

gm_install_packages "${gm_build_packages[@]}" "${gm_test_packages[@]}"
gm_make_venv build/venv tools/requirements.txt tools/report/requirements.txt \
  tests/requirements.txt
gm_build build -DCMAKE_BUILD_TYPE=Release -DGM_WERROR=ON -DGM_BUILD_TESTS=ON \
  -DGM_BUILD_BENCH=ON -DGM_PYTHON="$PWD/build/venv/bin/python"

gm_say "testing"
ctest --test-dir build --output-on-failure --parallel 2 "$@"
