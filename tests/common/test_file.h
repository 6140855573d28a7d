/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Files of a test: one temporary file that lives as long as the group of tests, and the
 * contents of any file. A call that fails fails the test.
 */
#ifndef TEST_FILE_H
#define TEST_FILE_H

#include <stddef.h>

/** Set-up and tear-down of a group of tests (cmocka): the temporary file. */
int test_file_make(void **state);
int test_file_remove(void **state);

/** Its path, for the life of the group. */
const char *test_file_path(void);

/** Give it this content. */
void test_file_write(const char *text);

/** Contents of a file as a text; it must fit into size bytes. Returns its length. */
size_t test_file_load(const char *path, char *text, size_t size);

#endif
