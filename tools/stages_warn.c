/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Where the tolerance of a sweep was not reached: in words for people, members for
 * machines.
 */
#include "stages.h"

#include "map/map_rules.h"

#include <math.h>
#include <string.h>

#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */
#define WORDS 160

static bool is_by_error(const gm_sweep_stage *stage)
{
    return stage->tolerance.share > 0.0 || stage->tolerance.torque > 0.0;
}

static void append(char *text, const char *words)
{
    size_t used = strlen(text);
    (void)snprintf(text + used, WORDS - used, "%s", words);
}

/* "8 x 13 nodes, at 300 rpm, -20 N·m" */
static void place_of(const gm_sweep_missed *m, char text[WORDS])
{
    const gm_symbol_rule *rule = gm_symbol_rule_of(m->key.symbol);
    char part[48];
    text[0] = '\0';
    for (int a = 0; a < rule->n_axes; a++) {
        (void)snprintf(part, sizeof part, "%s%d", a ? " x " : "", m->n[a]);
        append(text, part);
    }
    append(text, " nodes; ");
    for (int a = 0; a < rule->n_axes; a++) {
        bool speed = strcmp(rule->axis[a].unit, "rad/s") == 0;
        (void)snprintf(part, sizeof part, "%s%.4g %s", a ? ", " : "",
                       m->worst[a] * (speed ? RPM_PER_RAD_S : 1.0),
                       speed ? "rpm" : "N·m");
        append(text, part);
    }
}

static void warn_missed(const gm_sweep_stage *stage, const gm_sweep_missed *m)
{
    char key[GM_KEY_TEXT], place[WORDS];
    gm_map_key_text(stage->map, &m->key, key);
    place_of(m, place);
    fprintf(stderr,
            "gearmap: warning: %d of %d tables of this kind would need more nodes than "
            "they may have; the worst: %s, %s, %.2g %% of the largest\n",
            m->tables, m->of, key, place, 100.0 * m->error);
}

/* The largest error of a kind of points that is outside, with its case. */
static const gm_verify_case *outside(const gm_sweep_stage *sweep,
                                     const gm_verify_result *r, int group)
{
    const gm_verify_case *worst = NULL;
    for (int i = 0; i < r->n_cases[group]; i++) {
        const gm_verify_case *c = &r->cases[group][i];
        double allowed =
            fmax(sweep->tolerance.share * c->largest_loss, sweep->tolerance.torque);
        if (c->max > allowed && (!worst || c->max_relative > worst->max_relative))
            worst = c;
    }
    return worst;
}

void gm_stage_warn_left_out(const gm_verify_stage *stage)
{
    const gm_verify_result *r = &stage->result;
    if (r->n_skipped > 0)
        fprintf(stderr,
                "gearmap: warning: the model failed at %d points of the verification, "
                "which are left out; the first: %s\n",
                r->n_skipped, r->skipped);
}

void gm_stage_warn_skips(const gm_sweep_stage *stage)
{
    const gm_sweep_summary *s = &stage->summary;
    for (int i = 0; i < s->n_skipped; i++)
        fprintf(stderr, "gearmap: warning: skipped: %s\n", s->skipped[i].words);
    if (s->n_skipped > 0)
        fprintf(stderr,
                "gearmap: warning: the model failed at %d of %ld points, twice each; "
                "their values come from their neighbours\n",
                s->n_skipped, s->points + s->resumed);
}

void gm_stage_warn(const gm_sweep_stage *sweep, const gm_verify_stage *verify)
{
    if (!is_by_error(sweep))
        return;
    for (int s = 0; s < GM_SYMBOLS; s++)
        if (sweep->summary.missed[s].tables > 0)
            warn_missed(sweep, &sweep->summary.missed[s]);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++) {
        const gm_verify_case *c = outside(sweep, &verify->result, g);
        if (c)
            fprintf(stderr,
                    "gearmap: warning: %s: the tolerance is not reached: %.3g N·m, "
                    "%.2g %% of the largest, at %.0f rpm, %.1f N·m of path %s\n",
                    gm_stage_group_title(g), c->max, 100.0 * c->max_relative,
                    c->worst_speed * RPM_PER_RAD_S, c->worst_torque, c->path);
    }
}

void gm_stage_missed_json(const gm_sweep_stage *stage, gm_json *json)
{
    if (!is_by_error(stage))
        return;
    gm_json_object(json, "tolerance");
    gm_json_number(json, "relative", stage->tolerance.share);
    gm_json_number(json, "Nm", stage->tolerance.torque);
    gm_json_array(json, "missed");
    for (int s = 0; s < GM_SYMBOLS; s++) {
        const gm_sweep_missed *m = &stage->summary.missed[s];
        char key[GM_KEY_TEXT], place[WORDS];
        if (m->tables == 0)
            continue;
        gm_map_key_text(stage->map, &m->key, key);
        place_of(m, place);
        gm_json_object(json, NULL);
        gm_json_text(json, "symbol", gm_symbol_name((gm_symbol)s));
        gm_json_integer(json, "tables", m->tables);
        gm_json_integer(json, "of", m->of);
        gm_json_text(json, "worst_table", key);
        gm_json_text(json, "worst_at", place);
        gm_json_number(json, "worst_relative", m->error);
        gm_json_end(json);
    }
    gm_json_end(json);
    gm_json_end(json);
}
