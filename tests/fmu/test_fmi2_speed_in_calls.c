/* SPDX-License-Identifier: BSD-2-Clause
 *
 * test_fmi2_speed_in_calls [SEQUENCES]: random calls of the FMU where motion comes in at
 * a path and at the output.
 */
#include "random_calls.h"

int main(int argc, char **argv)
{
    return random_main(argc, argv);
}
