/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: what the component tells of itself in words.
 */
#include "fmi2_instance.h"

fmi2Status fmi2_report(fmi2_instance *f, const char *function)
{
    fmi2Status status = fmi2OK;
    if (gm_run_is_quiet(&f->run))
        return fmi2OK;
    for (int p = 0; p < gm_model_map()->n_paths; p++) {
        if (!gm_run_gear_refused(&f->run, p))
            continue;
        fmi2_log(f, fmi2Warning, FMI2_LOG_WARNING,
                 "%s: %s.gear = %d: there is no such gear; the path keeps the gear that "
                 "was",
                 function, gm_model_path_name(p),
                 f->run.component.value[GM_PATH_GEAR][p].integer);
        status = fmi2Warning;
    }
    if (gm_run_map_left(&f->run)) {
        fmi2_log(
            f, fmi2Warning, FMI2_LOG_WARNING,
            "%s: at %g s the operating point left the map; edge values are used (told "
            "once, see out_of_map)",
            function, f->run.time);
        status = fmi2Warning;
    }
    return status;
}

void fmi2_log_shifts(const fmi2_instance *f, const gm_path_state *before)
{
    for (int p = 0; p < gm_model_map()->n_paths; p++) {
        const gm_path_state *now = &f->run.component.state.path[p];
        if (now->mode == before[p].mode && now->gear == before[p].gear)
            continue;
        const char *what = now->mode == GM_PATH_ENGAGED         ? "engaged"
                           : now->mode == GM_PATH_SYNCHRONISING ? "synchronising"
                                                                : "neutral";
        int number = now->gear < 0 ? 0 : gm_model_map()->path[p].gears[now->gear].number;
        fmi2_log(f, fmi2OK, FMI2_LOG_EVENTS, "%g s: %s: gear %d, %s", f->run.time,
                 gm_model_path_name(p), number, what);
    }
}
