/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Derivatives of a component in Model Exchange: its directional derivatives, one state at
 * a time, where its rates depend on that state.
 */
#include "plant/fmu_motion.h"

static int depends(const fmu_state *state, int on)
{
    for (int k = 0; k < state->n_dependencies; k++)
        if (state->dependencies[k] == on)
            return 1;
    return state->n_dependencies < 0;
}

/* The diagonal always belongs to the pattern. */
static int fill_pattern(const gm_fmu_motion *m, int *column_start, int *row)
{
    int n = 0;
    for (int k = 0; k < m->n; k++) {
        if (column_start)
            column_start[k] = n;
        for (int i = 0; i < m->n; i++)
            if (i == k || depends(&m->fmu->description.states[i], k)) {
                if (row)
                    row[n] = i;
                n++;
            }
    }
    if (column_start)
        column_start[m->n] = n;
    return n;
}

int gm_fmu_motion_entries(const void *user)
{
    return fill_pattern(user, NULL, NULL);
}

void gm_fmu_motion_pattern(const void *user, int *column_start, int *row)
{
    (void)fill_pattern(user, column_start, row);
}

static int derivative(gm_fmu_motion *m, fmi2ValueReference by, double *column)
{
    const double one = 1.0;
    return m->fmu->library.GetDirectionalDerivative(m->fmu->component, m->rate_reference,
                                                    (size_t)m->n, &by, 1, &one,
                                                    column) > fmi2Warning;
}

static int column_matters(const gm_fmu_motion *m, int k)
{
    for (int i = 0; i < m->n; i++)
        if (depends(&m->fmu->description.states[i], k))
            return 1;
    return 0;
}

int gm_fmu_motion_jacobian(void *user, const gm_motion_input *input, const double *x,
                           double *value)
{
    gm_fmu_motion *m = user;
    int flag = gm_fmu_motion_put(m, input, x);
    for (int k = 0, n = 0; k < m->n && !flag; k++) {
        int matters = column_matters(m, k);
        if (matters)
            flag = derivative(m, m->state_reference[k], m->column);
        for (int i = 0; i < m->n; i++)
            if (i == k || depends(&m->fmu->description.states[i], k))
                value[n++] = matters ? m->column[i] : 0.0;
    }
    return flag;
}

/* The rates are linear in the torques but for losses: a difference of 1 N.m suits. */
static int torque_difference(gm_fmu_motion *m, const gm_motion_input *input,
                             const double *x, int flange, double *column)
{
    gm_motion_input moved = *input;
    moved.torque[flange] += 1.0;
    int flag = gm_fmu_motion_rates(m, &moved, x, column);
    if (!flag)
        flag = gm_fmu_motion_rates(m, input, x, m->column);
    for (int i = 0; i < m->n && !flag; i++)
        column[i] -= m->column[i];
    return flag;
}

int gm_fmu_motion_torque_column(void *user, const gm_motion_input *input, const double *x,
                                int flange, double *column)
{
    gm_fmu_motion *m = user;
    if (!m->plant->directional)
        return torque_difference(m, input, x, flange, column);
    return gm_fmu_motion_put(m, input, x) || derivative(m, m->tau[flange], column);
}
