/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/fmi_instance.h"

#include "base/alloc.h"
#include "plant/fmu_archive.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int gm_fmi_find(void *library, const char *prefix, const char *name, void *function,
                size_t size)
{
    char full[96];
    (void)snprintf(full, sizeof full, "%s%s", prefix, name);
    /* POSIX gives functions as void *; this is its own way to turn them into functions */
    void *symbol = dlsym(library, full);
    memcpy(function, &symbol, size);
    return symbol != NULL;
}

static gm_status load(fmi_instance *it, const char *folder, gm_error *error)
{
    char path[4096];
    const fmu_description *d = it->description;
    const char *identifier =
        it->mode == FMI_STEPS ? d->identifier : d->exchange_identifier;
    if (!identifier)
        return gm_fail(error, GM_ERR_FORMAT, "the FMU does not offer %s",
                       it->mode == FMI_STEPS ? "Co-Simulation" : "Model Exchange");
    if (snprintf(path, sizeof path, "%s/binaries/%s/%s" GM_LIBRARY_ENDING, folder,
                 it->is->platform, identifier) >= (int)sizeof path ||
        access(path, R_OK) != 0)
        return gm_fail(
            error, GM_ERR_FORMAT,
            "the FMU has no library for this platform (binaries/%s/%s" GM_LIBRARY_ENDING
            ")",
            it->is->platform, identifier);
    it->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!it->library)
        return gm_fail(error, GM_ERR_TOOL, "the FMU's library cannot be loaded: %s",
                       dlerror());
    const char *missing = it->is->load(it);
    if (missing)
        return gm_fail(error, GM_ERR_FORMAT, "the FMU's library has no function fmi%d%s",
                       d->version, missing);
    return GM_OK;
}

gm_status gm_fmi_renew(fmi_instance *it, const char *folder, gm_error *error)
{
    if (it->component)
        it->is->release(it);
    it->message[0] = '\0';
    it->component = it->is->instantiate(it, folder);
    if (it->component)
        return GM_OK;
    return gm_fail(error, GM_ERR_TOOL, "the FMU cannot be instantiated%s%s",
                   it->message[0] ? ": " : "", it->message);
}

gm_status gm_fmi_open(const fmu_description *description, const char *folder,
                      fmi_mode mode, fmi_instance **it, gm_error *error)
{
    fmi_instance *made = gm_calloc(1, sizeof *made);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    made->is = description->version == 3 ? &gm_fmi_version_3 : &gm_fmi_version_2;
    made->description = description;
    made->mode = mode;
    gm_status status = load(made, folder, error);
    if (status == GM_OK)
        status = gm_fmi_renew(made, folder, error);
    if (status != GM_OK) {
        gm_fmi_close(made);
        return status;
    }
    *it = made;
    return GM_OK;
}

void gm_fmi_close(fmi_instance *it)
{
    if (!it)
        return;
    if (it->component)
        it->is->release(it);
    if (it->library)
        (void)dlclose(it->library);
    gm_free(it->functions);
    gm_free(it);
}

gm_status gm_fmi_check(const fmi_instance *it, const char *called, fmi_answer answer,
                       gm_error *error)
{
    static const char *const words[] = {"OK",    "Warning", "Discard",
                                        "Error", "Fatal",   "Pending"};
    if (answer == FMI_OK || answer == FMI_WARNING)
        return GM_OK;
    return gm_fail(error, GM_ERR_TOOL, "fmi%d%s answered %s%s%s",
                   it->description->version, called,
                   (int)answer < 6 && (int)answer >= 0 ? words[answer] : "nonsense",
                   it->message[0] ? ": " : "", it->message);
}
