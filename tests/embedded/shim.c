/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The folder as a shared library of plain calls, for tests in Python.
 */
#include "gm_gearset.h"
#include "gm_tables.h"

static gm_gearset g;
static gm_reduced_inputs in;

int shim_start(int fidelity, double w_o, int gear_0, int gear_1);
void shim_set(double tau_0, double tau_1, double tau_o, int gear_0, int gear_1);
int shim_step(double h, int steps);
double shim_get(int which);

int shim_start(int fidelity, double w_o, int gear_0, int gear_1)
{
    gm_gearset_start start;
    gm_gearset_defaults(&gm_tables_map, &start);
    start.params.fidelity = fidelity;
    start.w_o = (gm_real)w_o;
    start.gear[0] = gear_0;
    start.gear[1] = gear_1;
    return gm_gearset_init(&gm_tables_map, &start, &g);
}

void shim_set(double tau_0, double tau_1, double tau_o, int gear_0, int gear_1)
{
    in.path_tau[0] = (gm_real)tau_0;
    in.path_tau[1] = (gm_real)tau_1;
    in.output_tau = (gm_real)tau_o;
    in.gear[0] = gear_0;
    in.gear[1] = gear_1;
    gm_gearset_set(&in, &g);
}

int shim_step(double h, int steps)
{
    int flags = 0;
    for (int i = 0; i < steps; i++) {
        flags |= gm_gearset_step(&gm_tables_map, &g, (gm_real)h);
    }
    return flags;
}

/* Speeds of the output and the paths, angle, twists, work, loss energy, inertia and
 * acceleration of the output, loss power. */
double shim_get(int which)
{
    gm_gearset_outputs o;
    if (gm_gearset_get(&gm_tables_map, &g, &o) & GM_FLAG_NOT_FINITE) {
        return -1;
    }
    const double value[] = {(double)o.w_o,
                            (double)o.w[0],
                            (double)o.w[1],
                            (double)o.phi_o.high + (double)o.phi_o.low,
                            (double)o.twist[0],
                            (double)o.twist[1],
                            (double)o.work.high + (double)o.work.low,
                            (double)o.loss_energy.high + (double)o.loss_energy.low,
                            (double)o.at.inertia_o,
                            (double)o.at.a_o,
                            (double)o.at.loss_power};
    return value[which];
}
