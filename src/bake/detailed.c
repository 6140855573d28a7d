/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset as an FMI 2.0 FMU: the description itself, a library that reads it
 * (fmu_detailed/, made when the program was built), and what its interface is.
 *
 *   binaries/linux64/<name>.so   documentation/index.html, licenses/
 *   modelDescription.xml         resources/gearset.yaml
 */
#include "bake/gm_bake.h"

#include "bake/detailed_description.h"
#include "bake/page.h"
#include "bake/place.h"

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 4096 };

typedef struct job {
    const char *source, *share;
    gm_detailed_subject subject;
    char identifier[GM_IDENTIFIER_SIZE], guid[GM_MOTION_GUID_SIZE];
    gm_package package;
    long library_size;
    gm_error *error;
} job;

/* ---- the page ---- */

static const char *const use[] = {
    "The interface is that of the reduced gearset that gearmap makes from the same "
    "description: names, units, causalities and value references are the same, so the "
    "two "
    "are exchanged for each other without rewiring. Behind the common variables follow "
    "the "
    "speed of every part, deflection and force of every mesh, loads and friction torques "
    "of all bearings.",
    "For Model Exchange. Meshes, locks and shafts are elastic, with backlash: solvers "
    "for "
    "stiff systems are needed (backward differences; orders above two gain little, since "
    "meshes are lightly damped). Nominal values of the states say what a usual value is; "
    "directional derivatives of all rates are exact and sparse.",
    "Every lock has an event indicator, which falls through zero when its cones have "
    "made "
    "the speeds equal. Gears are read at events, and so is the temperature of the oil: a "
    "change of more than 0.1 K asks for an event after the step.",
    "<code>fidelity</code> is there for the sake of the exchange and has no effect, "
    "<code>out_of_map</code> is always false. <code>loss_torque</code> of an engaged "
    "path "
    "is what load adds to the friction of all parts, <code>output.loss_torque</code> the "
    "rest.",
};

static void write_page(const job *j, gm_buffer *page)
{
    const gm_description *d = gm_gearset_description(j->subject.gearset);
    const char *title = d->title && d->title[0] ? d->title : d->name;
    gm_page_begin(page, title);
    gm_buffer_text(page, "<h1>");
    gm_page_escaped(page, title);
    gm_buffer_text(page,
                   "</h1>\n<p class=\"lead\">The detailed gearset: %d parts, %d "
                   "meshes and %d bearings in motion.</p>\n",
                   d->n_shafts + d->n_wheels, d->n_meshes, d->n_bearings);
    gm_page_heading(page, "Use");
    for (size_t i = 0; i < sizeof use / sizeof *use; i++)
        gm_buffer_text(page, "<p>%s</p>\n", use[i]);
    gm_page_heading(page, "Origin");
    gm_buffer_text(page,
                   "<p>Made by gearmap " GM_VERSION " from a description with the "
                   "SHA-256 <code>%s</code>, which is in <code>resources/"
                   "gearset.yaml</code>. GUID <code>%s</code>.</p>\n",
                   d->sha256, j->guid);
    gm_page_end(page);
}

/* ---- the package ---- */

static gm_status add_page(job *j)
{
    gm_buffer page = {0};
    write_page(j, &page);
    return gm_package_add(&j->package, "documentation/index.html", &page, j->error);
}

static gm_status add_description(job *j)
{
    gm_buffer text = {0};
    gm_status status = gm_detailed_description_write(&j->subject, &text, j->error);
    if (status == GM_OK)
        status = gm_package_add(&j->package, "modelDescription.xml", &text, j->error);
    else
        gm_buffer_clear(&text);
    return status;
}

static gm_status add_shared(job *j, const char *name, const char *file)
{
    char path[PATH_SIZE];
    if (snprintf(path, sizeof path, "%s/%s", j->share, file) >= (int)sizeof path)
        return gm_fail(j->error, GM_ERR_IO, "%s: the path is too long", j->share);
    return gm_package_add_file(&j->package, name, path, j->error);
}

/* Licences of the libraries that are part of the binary; there are none where it uses
 * those of the system. */
static gm_status add_licences(job *j)
{
    static const char *const library[] = {"libfyaml", "libmd"};
    char name[128], file[64], path[PATH_SIZE];
    gm_status status = add_shared(j, "documentation/licenses/license.txt", "LICENSE");
    for (int i = 0; i < 2 && status == GM_OK; i++) {
        (void)snprintf(name, sizeof name, "documentation/licenses/%s.txt", library[i]);
        (void)snprintf(file, sizeof file, "detailed/%s.txt", library[i]);
        if (snprintf(path, sizeof path, "%s/%s", j->share, file) < (int)sizeof path &&
            access(path, R_OK) == 0)
            status = add_shared(j, name, file);
    }
    return status;
}

static gm_status add_library(job *j)
{
    char name[GM_IDENTIFIER_SIZE + 64];
    (void)snprintf(name, sizeof name,
                   "binaries/" GM_FMI2_PLATFORM "/%s" GM_LIBRARY_ENDING, j->identifier);
    gm_status status = add_shared(j, name, "detailed/gearset" GM_LIBRARY_ENDING);
    if (status == GM_OK)
        j->library_size = (long)j->package.files[j->package.n - 1].content.size;
    return status;
}

static gm_status build_package(job *j)
{
    gm_status status = add_library(j);
    if (status == GM_OK)
        status = add_licences(j);
    if (status == GM_OK)
        status = add_description(j);
    if (status == GM_OK)
        status = add_page(j);
    if (status == GM_OK)
        status = gm_package_add_file(&j->package, "resources/gearset.yaml", j->source,
                                     j->error);
    gm_package_sort(&j->package);
    return status;
}

/* ---- all ---- */

static gm_status bake_motion(job *j, gm_motion *motion)
{
    const gm_description *d = gm_gearset_description(j->subject.gearset);
    gm_motion_variables variables = {0};
    gm_status status = gm_motion_variables_make(motion, &variables, j->error);
    gm_make_identifier(d->name, j->identifier);
    if (status == GM_OK)
        status = gm_motion_guid(motion, &variables, j->guid, j->error);
    j->subject.motion = motion;
    j->subject.variables = &variables;
    j->subject.identifier = j->identifier;
    j->subject.guid = j->guid;
    if (status == GM_OK)
        status = build_package(j);
    gm_motion_variables_clear(&variables);
    return status;
}

static gm_status bake_gearset(job *j)
{
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_motion *motion = NULL;
    gm_status status = gm_description_read(j->source, &description, j->error);
    if (status == GM_OK)
        status = gm_gearset_create(description, description->oil.temperature, &gearset,
                                   j->error);
    if (status == GM_OK)
        status = gm_motion_create(gearset, &motion, j->error);
    j->subject.gearset = gearset;
    if (status == GM_OK)
        status = bake_motion(j, motion);
    gm_motion_destroy(motion);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    return status;
}

gm_status gm_bake_detailed(const char *description, const char *share, const char *path,
                           gm_bake_summary *summary, gm_error *error)
{
    job j = {.source = description, .share = share, .error = error};
    gm_place place;
    struct stat info;
    gm_status status = gm_place_reserve(path, &place, error);
    if (status == GM_OK)
        status = bake_gearset(&j);
    if (status == GM_OK)
        status = gm_place_put(&place, &j.package, error);
    gm_place_release(&place);
    gm_package_clear(&j.package);
    if (status != GM_OK)
        return status;
    *summary = (gm_bake_summary){.library_size = j.library_size};
    if (stat(path, &info) == 0)
        summary->file_size = (long)info.st_size;
    (void)snprintf(summary->guid, sizeof summary->guid, "%s", j.guid);
    return GM_OK;
}
