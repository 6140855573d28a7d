/* SPDX-License-Identifier: BSD-2-Clause */
#include "file_fixture.h"

#include "base/alloc.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

char file_folder[64], file_path[96], file_part[104];

int file_setup(void **state)
{
    (void)state;
    strcpy(file_folder, "/tmp/gm_map_XXXXXX");
    if (!mkdtemp(file_folder))
        return -1;
    (void)snprintf(file_path, sizeof file_path, "%s/a map?.map", file_folder);
    (void)snprintf(file_part, sizeof file_part, "%s.part", file_path);
    return 0;
}

static bool exists(const char *name)
{
    return access(name, F_OK) == 0;
}

/* True when nothing but the named file (NULL: nothing) is in the folder. */
bool file_only(const char *name)
{
    char command[400];
    (void)snprintf(command, sizeof command, "test \"$(ls -A '%s' | wc -l)\" -eq %d",
                   file_folder, name ? 1 : 0);
    return (!name || exists(name)) && system(command) == 0;
}

int file_teardown(void **state)
{
    (void)state;
    char command[128];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", file_folder);
    return system(command);
}

gm_journal *file_journal(const gm_map *map)
{
    gm_error error;
    gm_journal *journal = NULL;
    if (gm_journal_open(file_path, map, sizeof(file_record), &journal, &error) != GM_OK)
        fail_msg("%s", error.message);
    return journal;
}

static double value_of(long n)
{
    return 0.1 * (double)n;
}

void file_put(gm_journal *journal, int first, int last)
{
    for (int n = first; n < last; n += 3) {
        gm_error error;
        file_record records[3];
        int size = last - n < 3 ? last - n : 3;
        for (int i = 0; i < size; i++)
            records[i] = (file_record){n + i, value_of(n + i)};
        if (gm_journal_put(journal, records, size, &error) != GM_OK)
            fail_msg("%s", error.message);
    }
}

void file_expect_records(const gm_journal *journal, int n)
{
    long count;
    const file_record *records = gm_journal_records(journal, &count);
    assert_int_equal(count, n);
    for (int i = 0; i < n; i++)
        assert_true(records[i].n == i && records[i].value == value_of(i));
}

void file_finish(gm_journal *journal, gm_map *map)
{
    gm_error error;
    if (gm_journal_finish(journal, map, &error) != GM_OK)
        fail_msg("%s", error.message);
}

/* Write a finished map at path. */
void file_write_map(gm_map *map)
{
    file_finish(file_journal(map), map);
}

gm_map *file_read_map(const char *name)
{
    gm_error error;
    gm_map *map = NULL;
    if (gm_map_read(name, &map, &error) != GM_OK)
        fail_msg("%s", error.message);
    return map;
}

void file_write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

unsigned char *file_read_bytes(const char *name, size_t *size)
{
    struct stat info;
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &info), 0);
    *size = (size_t)info.st_size;
    unsigned char *bytes = gm_calloc(*size, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    (void)fclose(file);
    return bytes;
}

void file_expect_refusal(const char *name, gm_status status, const char *words)
{
    gm_error error = {0};
    gm_map *map = NULL;
    assert_int_equal(gm_map_read(name, &map, &error), status);
    assert_null(map);
    if (!strstr(error.message, words) || !strstr(error.message, name))
        fail_msg("'%s' does not say '%s' of %s", error.message, words, name);
}
