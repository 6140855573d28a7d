/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The loader of FMUs: a baked one runs, everything malformed is refused with a sentence
 * and leaves no temporary folder.
 */
#include "baked.h"
#include "plant/gm_fmu.h"

#include "bake/example_map.h"
#include "base/alloc.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <cmocka.h>

/* One folder for all tests of the program: temporary files and the FMUs. */
typedef struct place {
    char folder[64], temporary[96], good[96], bad[96];
} place;

static int make_place(void **state)
{
    place *at = calloc(1, sizeof *at);
    strcpy(at->folder, "/tmp/test_fmu-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->temporary, sizeof at->temporary, "%s/temporary", at->folder);
    snprintf(at->good, sizeof at->good, "%s/good.fmu", at->folder);
    snprintf(at->bad, sizeof at->bad, "%s/bad.fmu", at->folder);
    assert_int_equal(mkdir(at->temporary, 0700), 0);
    assert_int_equal(setenv("TMPDIR", at->temporary, 1), 0);
    baked_write(at->good);
    *state = at;
    return 0;
}

static int leftovers(const place *at)
{
    DIR *directory = opendir(at->temporary);
    struct dirent *entry;
    int n = 0;
    assert_non_null(directory);
    while ((entry = readdir(directory)) != NULL)
        n += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return n;
}

static int remove_place(void **state)
{
    place *at = *state;
    unlink(at->good);
    unlink(at->bad);
    assert_int_equal(rmdir(at->temporary), 0);
    assert_int_equal(rmdir(at->folder), 0);
    free(at);
    return 0;
}

static gm_fmu *open_good(const place *at)
{
    gm_fmu *fmu = NULL;
    gm_error error;
    if (gm_fmu_open(at->good, &fmu, &error) != GM_OK)
        fail_msg("%s", error.message);
    return fmu;
}

static unsigned find(const gm_fmu *fmu, const char *name)
{
    unsigned reference = 0;
    assert_int_equal(gm_fmu_find(fmu, name, &reference, NULL), GM_OK);
    return reference;
}

static double get(gm_fmu *fmu, const char *name)
{
    double value = 0;
    assert_int_equal(gm_fmu_get_real(fmu, find(fmu, name), &value, NULL), GM_OK);
    return value;
}

static void a_baked_fmu_runs(void **state)
{
    place *at = *state;
    gm_fmu *fmu = open_good(at);
    gm_error error;
    for (int run = 0; run < 2; run++) {
        assert_int_equal(gm_fmu_initialise(fmu, &error), GM_OK);
        assert_int_equal(gm_fmu_set_real(fmu, find(fmu, "output.w_start"), 30, &error),
                         GM_OK);
        assert_int_equal(gm_fmu_set_integer(fmu, find(fmu, "odd.gear"), 3, &error),
                         GM_OK);
        assert_int_equal(gm_fmu_start(fmu, &error), GM_OK);
        assert_true(get(fmu, "odd.w") == 180);
        for (int i = 0; i < 100; i++)
            assert_int_equal(gm_fmu_step(fmu, i * 0.01, 0.01, &error), GM_OK);
        assert_true(get(fmu, "odd.w") < 180 && get(fmu, "odd.w") > 0);
        assert_true(get(fmu, "loss_energy") > 0);
        assert_int_equal(gm_fmu_reset(fmu, &error), GM_OK);
    }
    gm_fmu_close(fmu);
    assert_int_equal(leftovers(at), 0);
}

static void variables_are_found_by_name(void **state)
{
    gm_fmu *fmu = open_good(*state);
    gm_error error;
    unsigned reference = 77;
    assert_int_equal(gm_fmu_has(fmu, "even.gear"), 1);
    assert_int_equal(gm_fmu_has(fmu, "input.gear"), 0);
    assert_int_equal(gm_fmu_find(fmu, "odd.nothing", &reference, &error), GM_ERR_FORMAT);
    assert_non_null(strstr(error.message, "odd.nothing"));
    assert_int_equal(reference, 77);
    gm_fmu_close(fmu);
}

static void what_it_was_made_from_is_read(void **state)
{
    gm_fmu *fmu = open_good(*state);
    gm_map *map = example_map(2);
    const gm_fmu_origin origin = gm_fmu_read_origin(fmu);
    assert_string_equal(origin.description_sha256, map->input_sha256);
    assert_string_equal(origin.map_hash, map->content_hash);
    assert_true(origin.oil_temperature == map->oil_temperature);
    gm_map_destroy(map);
    gm_fmu_close(fmu);
}

static void what_the_fmu_says_is_passed_on(void **state)
{
    gm_fmu *fmu = open_good(*state);
    gm_error error;
    double value = 5;
    assert_int_equal(gm_fmu_initialise(fmu, &error), GM_OK);
    assert_int_equal(gm_fmu_set_real(fmu, find(fmu, "odd.tau"), (double)NAN, &error),
                     GM_ERR_TOOL);
    assert_non_null(strstr(error.message, "odd.tau"));
    assert_int_equal(gm_fmu_step(fmu, 0, 0.001, &error), GM_ERR_TOOL);
    assert_non_null(strstr(error.message, "not allowed"));
    assert_int_equal(gm_fmu_get_real(fmu, 99999, &value, &error), GM_ERR_TOOL);
    assert_true(value == 5);
    gm_fmu_close(fmu);
}

static void several_fmus_live_side_by_side(void **state)
{
    place *at = *state;
    gm_fmu *a = open_good(at), *b = open_good(at);
    gm_fmu_close(a);
    assert_int_equal(gm_fmu_initialise(b, NULL), GM_OK);
    gm_fmu_close(b);
    gm_fmu_close(NULL);
    assert_int_equal(leftovers(at), 0);
}

/* ---- malformed ones ---- */

static void assert_refused(const place *at, const char *path, gm_status expected,
                           const char *word)
{
    gm_fmu *fmu = (gm_fmu *)at; /* has to stay untouched */
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_fmu_open(path, &fmu, &error), expected);
    assert_ptr_equal(fmu, at);
    if (!strstr(error.message, word) || !strstr(error.message, path))
        fail_msg("\"%s\" does not say \"%s\"", error.message, word);
    assert_int_equal(leftovers(at), 0);
}

static void add(zip_t *zip, const char *name, const char *text)
{
    zip_source_t *source = zip_source_buffer(zip, text, strlen(text), 0);
    assert_non_null(source);
    assert_true(zip_file_add(zip, name, source, ZIP_FL_OVERWRITE) >= 0);
}

/* A small archive of two files. */
static zip_t *begin(const place *at)
{
    zip_t *zip = zip_open(at->bad, ZIP_CREATE | ZIP_TRUNCATE, NULL);
    assert_non_null(zip);
    return zip;
}

static void files_that_are_no_archives_are_refused(void **state)
{
    place *at = *state;
    FILE *file = fopen(at->bad, "wb");
    assert_non_null(file);
    assert_true(fputs("PK, but not really", file) >= 0);
    assert_int_equal(fclose(file), 0);
    assert_refused(at, at->bad, GM_ERR_FORMAT, "not a zip archive");
    assert_refused(at, "/nowhere/a.fmu", GM_ERR_IO, "cannot be read");
    assert_refused(at, at->folder, GM_ERR_FORMAT, "not a zip archive");
}

static void truncated_archives_are_refused(void **state)
{
    place *at = *state;
    struct stat info;
    assert_int_equal(stat(at->good, &info), 0);
    char *bytes = malloc((size_t)info.st_size);
    FILE *file = fopen(at->good, "rb");
    assert_true(bytes && file);
    assert_int_equal(fread(bytes, 1, (size_t)info.st_size, file), info.st_size);
    fclose(file);
    for (int part = 1; part < 8; part++) {
        gm_fmu *fmu;
        gm_error error;
        file = fopen(at->bad, "wb");
        assert_non_null(file);
        size_t n = (size_t)info.st_size * (size_t)part / 8;
        assert_int_equal(fwrite(bytes, 1, n, file), n);
        assert_int_equal(fclose(file), 0);
        assert_int_equal(gm_fmu_open(at->bad, &fmu, &error), GM_ERR_FORMAT);
        assert_int_equal(leftovers(at), 0);
    }
    /* one wrong byte in the middle of the largest file: the checksum tells */
    bytes[10000] = (char)(bytes[10000] ^ 0x40);
    file = fopen(at->bad, "wb");
    assert_int_equal(fwrite(bytes, 1, (size_t)info.st_size, file), info.st_size);
    assert_int_equal(fclose(file), 0);
    assert_refused(at, at->bad, GM_ERR_FORMAT, "damaged");
    free(bytes);
}

static void entries_that_leave_the_folder_are_refused(void **state)
{
    place *at = *state;
    const char *const names[] = {"../escaped",     "a/../../escaped", "/tmp/escaped",
                                 "a\\..\\escaped", "c:escaped",       "./a"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        zip_t *zip = begin(at);
        add(zip, names[i], "x");
        assert_int_equal(zip_close(zip), 0);
        assert_refused(at, at->bad, GM_ERR_FORMAT, "leave its folder");
        assert_int_not_equal(access("/tmp/escaped", F_OK), 0);
    }
}

static void links_are_refused(void **state)
{
    place *at = *state;
    zip_t *zip = begin(at);
    add(zip, "resources", "/tmp");
    assert_int_equal(
        zip_file_set_external_attributes(zip, 0, 0, ZIP_OPSYS_UNIX, 0120777u << 16), 0);
    assert_int_equal(zip_close(zip), 0);
    assert_refused(at, at->bad, GM_ERR_FORMAT, "leave its folder");
}

static void refuse_description(const place *at, const char *xml, const char *word)
{
    zip_t *zip = begin(at);
    add(zip, "modelDescription.xml", xml);
    assert_int_equal(zip_close(zip), 0);
    assert_refused(at, at->bad, GM_ERR_FORMAT, word);
}

#define ROOT "<fmiModelDescription fmiVersion=\"2.0\" guid=\"g\">"
#define CS "<CoSimulation modelIdentifier=\"m\"/>"

static void descriptions_that_cannot_be_are_refused(void **state)
{
    place *at = *state;
    zip_t *zip = begin(at);
    add(zip, "readme.txt", "nothing else");
    assert_int_equal(zip_close(zip), 0);
    assert_refused(at, at->bad, GM_ERR_FORMAT, "modelDescription.xml");
    refuse_description(at, "<fmiModelDescription", "well-formed");
    refuse_description(at, "<fmiModelDescription fmiVersion=\"1.0\"/>", "FMI 2.0");
    refuse_description(at, ROOT "<ModelVariables/></fmiModelDescription>",
                       "Co-Simulation");
    refuse_description(at,
                       ROOT "<CoSimulation modelIdentifier=\"../m\"/><ModelVariables/>"
                            "</fmiModelDescription>",
                       "identifier");
    refuse_description(at,
                       ROOT CS "<ModelVariables><ScalarVariable name=\"a\"/>"
                               "</ModelVariables></fmiModelDescription>",
                       "value reference");
    refuse_description(at,
                       ROOT CS "<ModelVariables><ScalarVariable name=\"a\" "
                               "valueReference=\"-1\"/></ModelVariables>"
                               "</fmiModelDescription>",
                       "value reference");
    refuse_description(at, ROOT CS "<ModelVariables/></fmiModelDescription>",
                       "no library");
}

static void outer_entities_are_not_read(void **state)
{
    place *at = *state;
    char xml[512];
    snprintf(xml, sizeof xml,
             "<!DOCTYPE x [<!ENTITY e SYSTEM \"file://%s\">]>" ROOT
             "<CoSimulation modelIdentifier=\"m\">&e;</CoSimulation><ModelVariables/>"
             "</fmiModelDescription>",
             "/etc/hostname");
    refuse_description(at, xml, "no library"); /* gets there without the entity */
}

static void libraries_that_are_none_are_refused(void **state)
{
    place *at = *state;
    zip_t *zip = begin(at);
    add(zip, "modelDescription.xml", ROOT CS "<ModelVariables/></fmiModelDescription>");
    add(zip, "binaries/linux64/m.so", "not an ELF file");
    assert_int_equal(zip_close(zip), 0);
    assert_refused(at, at->bad, GM_ERR_TOOL, "cannot be loaded");
}

static void a_wrong_guid_is_told_by_the_fmu(void **state)
{
    place *at = *state;
    char command[1024];
    /* the description of one FMU, the library of another */
    snprintf(command, sizeof command, "cp %s %s", at->good, at->bad);
    assert_int_equal(system(command), 0);
    zip_t *zip = zip_open(at->bad, 0, NULL);
    assert_non_null(zip);
    add(zip, "modelDescription.xml",
        ROOT "<CoSimulation modelIdentifier=\"example_2\"/><ModelVariables/>"
             "</fmiModelDescription>");
    assert_int_equal(zip_close(zip), 0);
    assert_refused(at, at->bad, GM_ERR_TOOL, "GUID");
}

static void failed_allocations_leave_nothing(void **state)
{
    place *at = *state;
    gm_status status = GM_ERR_MEMORY;
    int k = 1;
    for (; status != GM_OK && k < 500; k++) {
        gm_fmu *fmu = NULL;
        gm_alloc_fail_after(k);
        status = gm_fmu_open(at->good, &fmu, NULL);
        gm_alloc_fail_after(0);
        if (status == GM_OK)
            gm_fmu_close(fmu);
        assert_int_equal(leftovers(at), 0);
    }
    assert_true(k > 40 && status == GM_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_baked_fmu_runs),
        cmocka_unit_test(what_it_was_made_from_is_read),
        cmocka_unit_test(variables_are_found_by_name),
        cmocka_unit_test(what_the_fmu_says_is_passed_on),
        cmocka_unit_test(several_fmus_live_side_by_side),
        cmocka_unit_test(files_that_are_no_archives_are_refused),
        cmocka_unit_test(truncated_archives_are_refused),
        cmocka_unit_test(entries_that_leave_the_folder_are_refused),
        cmocka_unit_test(links_are_refused),
        cmocka_unit_test(descriptions_that_cannot_be_are_refused),
        cmocka_unit_test(outer_entities_are_not_read),
        cmocka_unit_test(libraries_that_are_none_are_refused),
        cmocka_unit_test(a_wrong_guid_is_told_by_the_fmu),
        cmocka_unit_test(failed_allocations_leave_nothing),
    };
    return cmocka_run_group_tests(tests, make_place, remove_place);
}
