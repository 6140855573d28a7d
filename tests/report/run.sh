#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# The pages of `gearmap report` in Debian's Chromium and in validators of HTML. Needs
# build/gearmap (./test.sh builds it) and, the first time, the network. Pictures of the
# pages are left in build/report. Arguments are passed to pytest.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/setup.sh

gm_install_packages chromium tidy fonts-dejavu-core
gm_make_venv build/report-venv tools/report/requirements.txt tests/report/requirements.txt
export GM_SOURCE_DIR=$PWD GEARMAP=$PWD/build/gearmap PYTHONDONTWRITEBYTECODE=1
export GM_PICTURES=$PWD/build/report
mkdir -p "$GM_PICTURES"

gm_say "pages in a browser"
cd tests/report
../../build/report-venv/bin/python -m pytest -q -p no:cacheprovider test_browser.py "$@"
