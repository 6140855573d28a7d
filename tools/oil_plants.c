/* SPDX-License-Identifier: BSD-2-Clause */
#include "oil_plants.h"

#include "base/alloc.h"
#include "map/gm_map.h"
#include "rig_source.h"
#include "sweep/verify_points.h"

#include <string.h>

/* A compiled model always gets the temperature; an FMU where a variable takes it. */
static gm_status check_rig(const gm_gearset_file *file, gm_error *error)
{
    if (!file->rig || gm_rig_source_takes_oil(file->rig))
        return GM_OK;
    return gm_fail(error, GM_ERR_MODEL,
                   "%s: names no variable that takes the oil temperature "
                   "(oil_temperature), so the model cannot be measured at several",
                   file->path);
}

static gm_status open_one(const gm_gearset_file *file, double temperature,
                          gm_gearset_file *made, gm_error *error)
{
    if (file->rig)
        return gm_gearset_file_open_any(file->path, temperature, &file->how, made, error);
    made->oil_temperature = temperature;
    gm_status status =
        gm_gearset_create(file->description, temperature, &made->gearset, error);
    if (status == GM_OK)
        status = gm_builtin_create(made->gearset, &made->solved, error);
    made->plant = made->solved;
    made->how = file->how;
    if (status != GM_OK || !file->measured)
        return status;
    status = gm_measured_builtin_create(made->gearset, made->solved, &made->how,
                                        &made->measured, error);
    if (status == GM_OK)
        made->plant = gm_measured_builtin_plant(made->measured);
    return status;
}

gm_status gm_oil_plants_open(const gm_gearset_file *file, int n,
                             const double *temperature, gm_oil_plants *plants,
                             gm_error *error)
{
    gm_oil_plants made = {.n = n};
    gm_status status = check_rig(file, error);
    if (status != GM_OK)
        return status;
    made.plant = gm_calloc((size_t)n, sizeof *made.plant);
    made.files = gm_calloc((size_t)n, sizeof *made.files);
    if (!made.plant || !made.files)
        status = gm_fail(error, GM_ERR_MEMORY, "no memory for the oil temperatures");
    for (int i = 0; i < n && status == GM_OK; i++) {
        status = open_one(file, temperature[i], &made.files[i], error);
        made.plant[i] = made.files[i].plant;
    }
    if (status == GM_OK)
        *plants = made;
    else
        gm_oil_plants_close(&made);
    return status;
}

/* Temperatures in an interval: an identified rig takes its time. */
#define HELD_OUT 4
#define HELD_OUT_RIG 1

gm_status gm_oil_plants_hold_out(const gm_gearset_file *file, int n, const double *axis,
                                 int seed, gm_oil_plants *plants, gm_error *error)
{
    double temperature[HELD_OUT * GM_MAP_MAX_OIL];
    const int parts = file->rig ? HELD_OUT_RIG : HELD_OUT;
    uint64_t random = (uint64_t)seed;
    for (int i = 0; i < parts * (n - 1); i++) {
        const double low = axis[i / parts];
        const double part = (axis[i / parts + 1] - low) / parts;
        temperature[i] = low + part * (i % parts + gm_random_between(&random, 0.0, 1.0));
    }
    gm_gearset_file truth = *file; /* what can be solved is not measured */
    truth.measured = NULL;
    return gm_oil_plants_open(&truth, parts * (n - 1), temperature, plants, error);
}

void gm_oil_plants_close(gm_oil_plants *plants)
{
    for (int i = 0; plants->files && i < plants->n; i++)
        gm_gearset_file_close(&plants->files[i]);
    gm_free(plants->files);
    gm_free(plants->plant);
    memset(plants, 0, sizeof *plants);
}

gm_status gm_oil_plant_at(void *self, double temperature, const gm_plant **plant,
                          gm_error *error)
{
    gm_oil_plant_list *list = self;
    gm_oil_plants *grown =
        gm_resize(list->plants, (size_t)list->n + 1, sizeof *list->plants);
    if (!grown)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the oil temperatures");
    list->plants = grown;
    gm_status status =
        gm_oil_plants_open(list->file, 1, &temperature, &grown[list->n], error);
    if (status == GM_OK)
        *plant = grown[list->n++].plant[0];
    return status;
}

void gm_oil_plant_list_clear(gm_oil_plant_list *list)
{
    for (int i = 0; i < list->n; i++)
        gm_oil_plants_close(&list->plants[i]);
    gm_free(list->plants);
    list->plants = NULL;
    list->n = 0;
}
