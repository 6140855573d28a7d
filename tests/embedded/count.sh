#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Instructions per step, code size and stack frames of the core on an emulated Cortex-M4F
# in float. For work on the core:
#   tests/embedded/count.sh FMU_OR_TABLES.h [steps]
# Takes gm_tables.h as it is or out of an FMU. Needs gcc-arm-none-eabi,
# libnewlib-arm-none-eabi and qemu-system-arm.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp "$here"/../../src/core/*.[ch] "$here"/../../embedded/gm_*.[ch] "$work"
sed -i 's/GM_REAL_IS_FLOAT 0/GM_REAL_IS_FLOAT 1/' "$work/gm_config.h"
case $1 in
*.fmu) unzip -qp "$1" sources/gm_tables.h >"$work/gm_tables.h" ;;
*) cp "$1" "$work/gm_tables.h" ;;
esac

arm=(arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
  -std=gnu99 ${OPTIMISE:--O2} -ffp-contract=off -ffunction-sections -fstack-usage)
cd "$work"
"${arm[@]}" -c ./*.c
core=(*.o)
"${arm[@]}" -I"$here" -I. -Wl,--gc-sections --specs=rdimon.specs -T "$here/m4/mps2.ld" \
  "$here/count.c" "$here/m4/start.c" "${core[@]}" -o count.elf
qemu-system-arm -M mps2-an386 -icount shift=6,align=off,sleep=off \
  -semihosting-config enable=on,target=native,arg=count,arg="${2:-100000}" \
  -nographic -monitor none -serial none -kernel count.elf
echo
arm-none-eabi-size -t "${core[@]}" | tail -n 1
echo "largest stack frames [bytes]:"
sort -k2 -n -r ./*.su -t "$(printf '\t')" | head -n 8 | cut -f 1,2
