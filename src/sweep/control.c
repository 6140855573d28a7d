/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/control.h"

#include "base/alloc.h"
#include "sweep/gm_oil.h"

#include <math.h>
#include <string.h>

#define LOT 16 /* points */

/* A unit under control. */
typedef struct controlled {
    gm_refine *refine; /* NULL: of a phase that has not begun */
    gm_refine_state state;
} controlled;

typedef struct lot {
    int unit, first, n;
} lot;

struct gm_control {
    gm_sweep_plan *plan;
    gm_control_tolerance tolerance;
    int phase;
    controlled *units; /* [n_units of the plan] */
    int n_lots, lots_size;
    lot *lots;
};

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "no memory for the error control of the sweep");
}

gm_status gm_control_create(gm_sweep_plan *plan, const gm_sweep_options *options,
                            gm_control **control, gm_error *error)
{
    gm_control *made = gm_calloc(1, sizeof *made);
    if (made) {
        made->plan = plan;
        /* Errors between oil temperatures come on top. */
        const double part = options->n_oil > 0 ? 1.0 - GM_OIL_PART : 1.0;
        made->tolerance = (gm_control_tolerance){part * options->tolerance_share,
                                                 part * options->tolerance_torque};
        made->units = gm_calloc((size_t)plan->n_units, sizeof *made->units);
    }
    if (made && made->units) {
        *control = made;
        return GM_OK;
    }
    gm_control_destroy(made);
    return no_memory(error);
}

void gm_control_destroy(gm_control *control)
{
    if (!control)
        return;
    for (int u = 0; control->units && u < control->plan->n_units; u++)
        gm_refine_destroy(control->units[u].refine);
    gm_free(control->units);
    gm_free(control->lots);
    gm_free(control);
}

/* Tolerance of a gear's loss at its flange in a slice, as its refinement ended with. */
static double load_tolerance(const gm_control *c, int path, int gear, int direction,
                             int slice)
{
    gm_table_key key = gm_sweep_load_key(path, gear, direction);
    const gm_map_table *table = gm_map_find(c->plan->map, &key);
    for (int u = 0; u < c->plan->n_units; u++)
        if (&c->plan->map->tables[c->plan->units[u].table] == table)
            return c->units[u].state.tolerance[2 * slice];
    return 0.0;
}

/* The strictest one of the engaged gears of a configuration, at the output. */
static double output_tolerance(const gm_control *c, const gm_table_key *key, int slice)
{
    const gm_map *map = c->plan->map;
    double least = HUGE_VAL;
    for (int p = 0; p < map->n_paths; p++) {
        double ratio = gm_sweep_ratio(map, p, key->gear[p]);
        int backward = (ratio < 0) != (key->direction[0] == GM_BACKWARD);
        if (ratio != 0.0)
            least = fmin(least, fabs(ratio) *
                                    load_tolerance(c, p, key->gear[p], backward, slice));
    }
    return least;
}

/* Of P of all slices; 0 where it has none: nothing is engaged, or another table. */
static int output_tolerances(const gm_control *c, const gm_unit *unit, double *output)
{
    const gm_map_table *table = &c->plan->map->tables[unit->table];
    if (unit->kind != GM_UNIT_PARASITIC)
        return 0;
    for (int k = 0; k < table->slices; k++)
        output[k] = output_tolerance(c, &table->key, k);
    return isfinite(output[0]);
}

gm_status gm_control_begin(gm_control *control, int phase, gm_error *error)
{
    gm_status status = GM_OK;
    const gm_sweep_plan *plan = control->plan;
    gm_refine_spec *spec = gm_calloc(1, sizeof *spec);
    if (!spec)
        return no_memory(error);
    control->phase = phase;
    for (int u = 0; u < plan->n_units && status == GM_OK; u++) {
        const gm_unit *unit = &plan->units[u];
        double output[GM_MAP_MAX_OIL];
        if (unit->phase != phase)
            continue;
        gm_control_spec(plan, unit, &control->tolerance,
                        output_tolerances(control, unit, output) ? output : NULL, spec);
        spec->seed = (uint64_t)u + 1;
        status = gm_refine_create(spec, &control->units[u].refine, error);
    }
    gm_free(spec);
    return status;
}

static gm_status add_lot(gm_control *c, lot of, gm_error *error)
{
    if (c->n_lots == c->lots_size) {
        int size = 2 * c->lots_size + 64;
        lot *lots = gm_resize(c->lots, (size_t)size, sizeof *lots);
        if (!lots)
            return no_memory(error);
        c->lots = lots;
        c->lots_size = size;
    }
    c->lots[c->n_lots++] = of;
    return GM_OK;
}

gm_status gm_control_lots(gm_control *control, int *n, gm_error *error)
{
    gm_status status = GM_OK;
    control->n_lots = 0;
    for (int u = 0; u < control->plan->n_units; u++) {
        const gm_refine *refine = control->units[u].refine;
        int wanted = refine ? gm_refine_wanted(refine) : 0;
        for (int i = 0; i < wanted && status == GM_OK; i += LOT) {
            lot of = {u, i, wanted - i < LOT ? wanted - i : LOT};
            status = add_lot(control, of, error);
        }
    }
    *n = control->n_lots;
    return status;
}

int gm_control_lot_size(const gm_control *control, int i)
{
    return control->lots[i].n;
}

gm_status gm_control_sample(gm_control *control, int i, gm_point_solver *solver,
                            gm_error *error)
{
    const lot *of = &control->lots[i];
    const gm_unit *unit = &control->plan->units[of->unit];
    gm_refine *refine = control->units[of->unit].refine;
    gm_status status = GM_OK;
    for (int k = of->first; k < of->first + of->n && status == GM_OK; k++) {
        gm_sample sample;
        status = gm_experiment_at(control->plan, unit, gm_refine_point(refine, k), solver,
                                  &sample, error);
        if (status == GM_OK)
            gm_refine_tell(refine, k, &sample);
    }
    return status;
}

gm_status gm_control_advance(gm_control *control, int unit, gm_error *error)
{
    gm_refine *refine = control->units[unit].refine;
    if (!refine || gm_refine_wanted(refine) == 0)
        return GM_OK;
    gm_status status = gm_refine_advance(refine, error);
    control->units[unit].state = gm_refine_state_of(refine);
    return status;
}

gm_status gm_control_end(gm_control *control, gm_error *error)
{
    gm_sweep_plan *plan = control->plan;
    gm_status status = GM_OK;
    for (int u = 0; u < plan->n_units && status == GM_OK; u++) {
        controlled *of = &control->units[u];
        gm_nodes axes[GM_MAX_AXES];
        if (!of->refine)
            continue;
        for (int a = 0; a < plan->map->tables[plan->units[u].table].n_axes; a++)
            axes[a] = *gm_refine_nodes(of->refine, a);
        status = gm_unit_set_axes(plan, &plan->units[u], axes, error);
        gm_refine_destroy(of->refine);
        of->refine = NULL;
    }
    return status;
}

double gm_control_worst(const gm_control *control)
{
    double worst = (double)NAN;
    for (int u = 0; u < control->plan->n_units; u++)
        if (control->plan->units[u].phase == control->phase &&
            control->units[u].state.error > 0.0)
            worst = fmax(worst, control->units[u].state.relative);
    return worst;
}

static void add_missed(const gm_map_table *table, const gm_refine_state *state,
                       gm_sweep_missed *missed)
{
    missed->of++;
    if (state->reached)
        return;
    if (missed->tables++ > 0 && state->relative <= missed->error)
        return;
    missed->key = table->key;
    missed->error = state->relative;
    memcpy(missed->n, table->n, sizeof missed->n);
    memcpy(missed->worst, state->worst, sizeof missed->worst);
}

void gm_control_missed(const gm_control *control, gm_sweep_missed *missed)
{
    const gm_sweep_plan *plan = control->plan;
    memset(missed, 0, GM_SYMBOLS * sizeof *missed);
    for (int u = 0; u < plan->n_units; u++) {
        const gm_map_table *table = &plan->map->tables[plan->units[u].table];
        add_missed(table, &control->units[u].state, &missed[table->key.symbol]);
    }
}
