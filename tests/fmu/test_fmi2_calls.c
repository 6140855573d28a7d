/* SPDX-License-Identifier: BSD-2-Clause
 *
 * test_fmi2_calls [SEQUENCES]: random calls of the FMU with torques in and speeds out.
 */
#include "random_calls.h"

int main(int argc, char **argv)
{
    return random_main(argc, argv);
}
