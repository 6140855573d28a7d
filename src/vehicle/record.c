/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/gm_record.h"

#include "base/alloc.h"

#include <math.h>

void gm_record_destroy(gm_record *record)
{
    if (!record)
        return;
    gm_free(record->sample);
    gm_free(record);
}

static gm_record *allocate(double duration, double step)
{
    gm_record *r = gm_calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->step = step;
    r->n = 1 + (int)floor(duration / step + 1e-9);
    r->sample = gm_calloc((size_t)r->n, sizeof *r->sample);
    if (r->sample)
        return r;
    gm_record_destroy(r);
    return NULL;
}

static gm_status drive(gm_trip *trip, gm_transient *transient,
                       const gm_record_progress *progress, gm_record *record,
                       gm_error *error)
{
    gm_status status = gm_transient_start(transient, 0.0, error);
    for (int i = 0; i < record->n && status == GM_OK; i++) {
        double t = i * record->step;
        if (i > 0)
            status = gm_transient_advance(transient, t, error);
        if (status != GM_OK)
            break;
        gm_sample *sample = &record->sample[i];
        gm_trip_look(trip, t, gm_transient_state(transient), &sample->view);
        sample->cpu = gm_transient_work(transient).cpu;
        if (progress && progress->call(progress->context, (double)i / record->n))
            status = gm_fail(error, GM_ERR_INTERRUPTED, "interrupted");
    }
    record->work = gm_transient_work(transient);
    record->energy = gm_transient_account(transient);
    record->gearset_time = gm_trip_gearset_time(trip);
    return status;
}

gm_status gm_record_create(const gm_trip_parts *parts,
                           const gm_transient_options *options, double step,
                           const gm_record_progress *progress, gm_record **record,
                           gm_error *error)
{
    gm_trip *trip = NULL;
    gm_transient *transient = NULL;
    gm_record *made = allocate(gm_cycle_duration(parts->cycle), step);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = gm_trip_create(parts, &trip, error);
    if (status == GM_OK) {
        gm_transient_system system = gm_trip_system(trip);
        status = gm_transient_create(&system, options, &transient, error);
    }
    if (status == GM_OK)
        status = drive(trip, transient, progress, made, error);
    gm_transient_destroy(transient);
    gm_trip_destroy(trip);
    if (status != GM_OK) {
        gm_record_destroy(made);
        return status;
    }
    *record = made;
    return GM_OK;
}

double gm_record_loss(const gm_record *record, int i)
{
    const gm_trip_view *first = &record->sample[0].view, *now = &record->sample[i].view;
    return now->gearset_work - now->gearset_stored -
           (first->gearset_work - first->gearset_stored);
}
