# SPDX-License-Identifier: BSD-2-Clause
# One interface target that carries the warning set of every object we compile.
# -ffp-contract=off: the core gives the same bits on every platform and compiler.
add_library(gm_warnings INTERFACE)
target_compile_options(gm_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion
  -Wmissing-prototypes -Wstrict-prototypes -Wvla -ffp-contract=off
  $<$<BOOL:${GM_WERROR}>:-Werror>)
