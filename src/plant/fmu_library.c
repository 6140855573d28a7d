/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/fmu_library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* POSIX gives functions as void *; this is its own way to turn them into functions. */
static int find(void *handle, const char *name, void *function, size_t size)
{
    void *symbol = dlsym(handle, name);
    memcpy(function, &symbol, size);
    return symbol != NULL;
}

static gm_status find_functions(const char *archive, fmu_library *library,
                                gm_error *error)
{
    const char *missing = NULL;
#define FMU_FIND(name)                                                                   \
    if (!find(library->handle, "fmi2" #name, &library->name, sizeof library->name))      \
        missing = "fmi2" #name;
    FMU_FUNCTIONS(FMU_FIND)
#undef FMU_FIND
#define FMU_FIND(name)                                                                   \
    (void)find(library->handle, "fmi2" #name, &library->name, sizeof library->name);
    FMU_EXCHANGE_FUNCTIONS(FMU_FIND)
#undef FMU_FIND
    if (!missing)
        return GM_OK;
    return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU's library has no function %s",
                   archive, missing);
}

gm_status gm_fmu_library_load(const char *folder, const char *identifier,
                              const char *archive, fmu_library *library, gm_error *error)
{
    fmu_library loaded = {0};
    if (snprintf(loaded.path, sizeof loaded.path,
                 "%s/binaries/" GM_FMI2_PLATFORM "/%s" GM_LIBRARY_ENDING, folder,
                 identifier) >= (int)sizeof loaded.path ||
        access(loaded.path, R_OK) != 0)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the FMU has no library for this platform (" GM_FMI2_PLATFORM
                       ")",
                       archive);
    loaded.handle = dlopen(loaded.path, RTLD_NOW | RTLD_LOCAL);
    if (!loaded.handle)
        return gm_fail(error, GM_ERR_TOOL, "%s: the FMU's library cannot be loaded: %s",
                       archive, dlerror());
    gm_status status = find_functions(archive, &loaded, error);
    if (status == GM_OK)
        *library = loaded;
    else
        gm_fmu_library_close(&loaded);
    return status;
}

int gm_fmu_library_exchanges(const fmu_library *l)
{
    return l->EnterEventMode && l->NewDiscreteStates && l->EnterContinuousTimeMode &&
           l->SetTime && l->SetContinuousStates && l->GetContinuousStates &&
           l->GetDerivatives && l->GetEventIndicators;
}

void gm_fmu_library_close(fmu_library *library)
{
    if (library->handle)
        dlclose(library->handle);
    library->handle = NULL;
}
