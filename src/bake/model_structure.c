/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Source: FMI for Model Exchange and Co-Simulation 2.0.3, section 2.2.8. One list serves
 * both kinds of instances: the knowns are inputs and continuous states; in Co-Simulation
 * the states are not known to the host, and their entries say nothing there.
 */
#include "bake/model_structure.h"

#include "bake/buffer.h"

typedef dependency (*dependency_rule)(const gm_speed_in *speed_in, scalar of, scalar on);

/* One Unknown with its exact dependencies; indices count from 1. */
static void write_unknown(xml *x, scalar unknown, dependency_rule rule)
{
    static const char *const name[] = {"", "dependent", "constant", "discrete"};
    gm_buffer on = {0}, kind = {0};
    for (int j = 0; j < x->n; j++) {
        dependency d = rule(&x->speed_in, unknown, x->all[j]);
        if (x->map->n_oil > 0 && x->all[j].id == VARIABLE_OIL_TEMPERATURE &&
            gm_bake_follows_oil(&x->speed_in, unknown))
            d = DEPENDENCY_DEPENDENT;
        if (d == DEPENDENCY_NONE)
            continue;
        gm_buffer_text(&on, "%s%d", on.size ? " " : "", j + 1);
        gm_buffer_text(&kind, "%s%s", kind.size ? " " : "", name[d]);
    }
    x->failed |= on.failed || kind.failed;
    gm_xml_start(x, "Unknown");
    gm_xml_integer(x, "index", gm_bake_index(x->all, x->n, unknown));
    gm_xml_text(x, "dependencies", on.data ? on.data : "");
    if (kind.data)
        gm_xml_text(x, "dependenciesKind", kind.data);
    gm_xml_end(x);
    gm_buffer_clear(&on);
    gm_buffer_clear(&kind);
}

static void write_derivatives(xml *x)
{
    scalar states[2 * N_VARIABLES], derivatives[2 * N_VARIABLES];
    int n = gm_bake_states(x->map->n_paths, &x->speed_in, states, derivatives);
    gm_xml_start(x, "Derivatives");
    for (int i = 0; i < n; i++)
        write_unknown(x, derivatives[i], gm_bake_depends);
    gm_xml_end(x);
}

/* InitialUnknowns by rule: outputs, states and derivatives that are calculated. All
 * states and derivatives are outputs; there are no calculated parameters. */
void gm_model_structure_write(xml *x)
{
    gm_xml_start(x, "ModelStructure");
    gm_xml_start(x, "Outputs");
    for (int i = 0; i < x->n; i++)
        if (gm_bake_variable(&x->speed_in, x->all[i]).causality == CAUSALITY_OUTPUT)
            write_unknown(x, x->all[i], gm_bake_depends);
    gm_xml_end(x);
    write_derivatives(x);
    gm_xml_start(x, "InitialUnknowns");
    for (int i = 0; i < x->n; i++)
        if (gm_bake_variable(&x->speed_in, x->all[i]).initial == INITIAL_CALCULATED)
            write_unknown(x, x->all[i], gm_bake_depends_initially);
    gm_xml_end(x);
    gm_xml_end(x);
}
