/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A component baked from the example map of tests/bake with two paths. A call that fails
 * fails the test.
 */
#ifndef BAKED_H
#define BAKED_H

/** Bake it into a file of this path. */
void baked_write(const char *path);

/** Set-up and tear-down of a group of tests (cmocka): *state is the path of one in a
 *  temporary folder. */
int baked_make(void **state);
int baked_remove(void **state);

#endif
