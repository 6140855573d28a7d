/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the gearset is: parts, ratios as the model turns, inertias, power flow.
 */
#include "check.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

#define KELVIN 273.15
#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */

/* At full torque and low speed, where the drag of what idles matters least. */
static gm_status find_flow(const gm_gearset_file *file, int p, int g, gm_power_flow *flow,
                           gm_error *error)
{
    const gm_description *d = file->description;
    const gm_point_request request = {.gear = d->paths[p].gears[g].number,
                                      .speed = 0.1 * d->speed_max,
                                      .torque = d->torque_max};
    gm_checked_point point;
    gm_status status = gm_check_point(file, &request, &point, error);
    if (status != GM_OK)
        return status;
    unsigned char *loaded = gm_calloc((size_t)d->n_meshes, 1);
    for (int m = 0; loaded && m < d->n_meshes; m++)
        loaded[m] = (unsigned char)gm_checked_point_loads(&point, d->meshes[m].id.name);
    status = loaded ? gm_power_flow_find(d, p, g, loaded, flow, error)
                    : gm_fail(error, GM_ERR_MEMORY, "%s: out of memory", d->file);
    gm_free(loaded);
    gm_checked_point_clear(&point);
    return status;
}

static gm_status identify(const gm_gearset_file *file, int p, int g,
                          gm_checked_gearset *c, gm_error *error)
{
    const gm_path_gear *gear = &file->description->paths[p].gears[g];
    int numbers[GM_MAX_INPUT_PATHS] = {0};
    gm_kinematics k;
    for (int i = 0; i < file->description->n_paths; i++)
        numbers[i] = gm_path_rest_gear(&file->description->paths[i]);
    numbers[p] = gear->number;
    gm_status status = gm_gearset_kinematics(file->gearset, numbers, &k, error);
    if (status != GM_OK)
        return status;
    gm_checked_gear *found = &c->gears[c->n_gears];
    status = find_flow(file, p, g, &found->flow, error);
    if (status != GM_OK)
        return status;
    c->inertia_output = k.inertia_output;
    memcpy(c->inertia, k.inertia, sizeof c->inertia);
    found->path = p;
    found->number = gear->number;
    found->ratio = k.ratio[p];
    found->ratio_given = gear->ratio;
    found->inertia = k.inertia_total / (k.ratio[p] * k.ratio[p]);
    c->n_gears++;
    return GM_OK;
}

gm_status gm_check_gearset(const gm_gearset_file *file, gm_checked_gearset *checked,
                           gm_error *error)
{
    const gm_description *d = file->description;
    gm_checked_gearset c = {.description = d, .oil_temperature = file->oil_temperature};
    gm_status status = GM_OK;
    int n = 0;
    for (int p = 0; p < d->n_paths; p++)
        n += d->paths[p].n_gears;
    c.gears = gm_calloc((size_t)n, sizeof *c.gears);
    if (!c.gears)
        return gm_fail(error, GM_ERR_MEMORY, "%s: out of memory", d->file);
    for (int p = 0; p < d->n_paths; p++)
        for (int g = 0; status == GM_OK && g < d->paths[p].n_gears; g++)
            status = identify(file, p, g, &c, error);
    if (status != GM_OK) {
        gm_checked_gearset_clear(&c);
        return status;
    }
    *checked = c;
    return GM_OK;
}

void gm_checked_gearset_clear(gm_checked_gearset *checked)
{
    for (int i = 0; i < checked->n_gears; i++)
        gm_power_flow_clear(&checked->gears[i].flow);
    gm_free(checked->gears);
    memset(checked, 0, sizeof *checked);
}

static void print_shafts(const gm_description *d, FILE *out)
{
    fprintf(out, "\nshafts              y [mm]   z [mm]  gears\n");
    for (int s = 0; s < d->n_shafts; s++) {
        const char *separator = "";
        fprintf(out, "  %-16s %8.2f %8.2f  ", d->shafts[s].id.name, 1e3 * d->shafts[s].y,
                1e3 * d->shafts[s].z);
        for (int w = 0; w < d->n_wheels; w++)
            if (d->wheels[w].shaft == s) {
                fprintf(out, "%s%s (%d%s)", separator, d->wheels[w].id.name,
                        d->wheels[w].teeth,
                        d->wheels[w].planets > 0 ? ", planets"
                        : d->wheels[w].idles     ? ", idles"
                                                 : "");
                separator = ", ";
            }
        fputc('\n', out);
    }
}

static void print_gear(const gm_checked_gearset *c, const gm_checked_gear *g, FILE *out)
{
    char given[32] = "-";
    if (!isnan(g->ratio_given))
        (void)snprintf(given, sizeof given, "%.4f", g->ratio_given);
    fprintf(out, "  %-6s %4d %10.5f %9s %12.6f  ", c->description->paths[g->path].id.name,
            g->number, g->ratio, given, g->inertia);
    for (int i = 0; i < g->flow.n; i++)
        fprintf(out, "%s%s", i > 0 ? " > " : "", g->flow.parts[i]);
    fputc('\n', out);
}

static void print_counts(const gm_description *d, FILE *out)
{
    const struct {
        int n;
        const char *one, *many;
    } parts[] = {
        {d->n_shafts, "shaft", "shafts"},
        {d->n_wheels, "gear", "gears"},
        {d->n_meshes, "mesh", "meshes"},
        {d->n_bearings, "bearing", "bearings"},
        {d->n_seals, "seal", "seals"},
        {d->n_synchronisers, "synchroniser", "synchronisers"},
        {d->n_clutches, "clutch", "clutches"},
    };
    const char *separator = ": ";
    fputs(d->file, out);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].n == 0)
            continue;
        fprintf(out, "%s%d %s", separator, parts[i].n,
                parts[i].n == 1 ? parts[i].one : parts[i].many);
        separator = ", ";
    }
    fputc('\n', out);
}

static int is_given(const char *text)
{
    return text && *text != '\0';
}

static void print_head(const gm_checked_gearset *checked, FILE *out)
{
    const gm_description *d = checked->description;
    fprintf(out, "%s%s%s\n", d->name, is_given(d->title) ? ": " : "",
            is_given(d->title) ? d->title : "");
    print_counts(d, out);
    if (is_given(d->oil.name))
        fprintf(out, "oil %s at %.1f °C\n", d->oil.name,
                checked->oil_temperature - KELVIN);
    else
        fprintf(out, "oil at %.1f °C\n", checked->oil_temperature - KELVIN);
}

void gm_checked_gearset_print(const gm_checked_gearset *checked, FILE *out)
{
    const gm_description *d = checked->description;
    print_head(checked, out);
    print_shafts(d, out);
    fprintf(out, "\ngears   no.      ratio     given   J [kg·m²]  power flow\n");
    for (int i = 0; i < checked->n_gears; i++)
        print_gear(checked, &checked->gears[i], out);
    fprintf(out, "\ninertia at the output %.6f kg·m²", checked->inertia_output);
    for (int p = 0; p < d->n_paths; p++)
        fprintf(out, ", at %s %.6f kg·m²", d->paths[p].id.name, checked->inertia[p]);
    fprintf(out, " (all in neutral; J: seen at the input in gear)\n");
}

static void shafts_json(const gm_description *d, gm_json *json)
{
    gm_json_array(json, "shafts");
    for (int s = 0; s < d->n_shafts; s++) {
        gm_json_object(json, NULL);
        gm_json_text(json, "name", d->shafts[s].id.name);
        gm_json_number(json, "y_mm", 1e3 * d->shafts[s].y);
        gm_json_number(json, "z_mm", 1e3 * d->shafts[s].z);
        gm_json_array(json, "gears");
        for (int w = 0; w < d->n_wheels; w++)
            if (d->wheels[w].shaft == s)
                gm_json_text(json, NULL, d->wheels[w].id.name);
        gm_json_end(json);
        gm_json_end(json);
    }
    gm_json_end(json);
}

static void locks_json(const gm_description *d, const gm_checked_gear *g, gm_json *json)
{
    const gm_path_gear *gear = gm_path_gear_of(&d->paths[g->path], g->number);
    gm_json_array(json, "locks");
    for (int i = 0; i < gear->n_locks; i++)
        gm_json_text(json, NULL, gm_lock_name(d, &gear->locks[i]));
    gm_json_end(json);
}

static void gear_json(const gm_description *d, const gm_checked_gear *g, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_integer(json, "number", g->number);
    locks_json(d, g, json);
    gm_json_number(json, "ratio", g->ratio);
    gm_json_number(json, "ratio_given", g->ratio_given);
    gm_json_number(json, "inertia_at_input_kgm2", g->inertia);
    gm_json_array(json, "power_flow");
    for (int i = 0; i < g->flow.n; i++)
        gm_json_text(json, NULL, g->flow.parts[i]);
    gm_json_end(json);
    gm_json_end(json);
}

static void paths_json(const gm_checked_gearset *c, gm_json *json)
{
    gm_json_array(json, "paths");
    for (int p = 0; p < c->description->n_paths; p++) {
        gm_json_object(json, NULL);
        const gm_path_part *path = &c->description->paths[p];
        gm_json_text(json, "name", path->id.name);
        gm_json_text(json, "shaft", c->description->shafts[path->shaft].id.name);
        gm_json_number(json, "inertia_kgm2", c->inertia[p]);
        gm_json_array(json, "gears");
        for (int i = 0; i < c->n_gears; i++)
            if (c->gears[i].path == p)
                gear_json(c->description, &c->gears[i], json);
        gm_json_end(json);
        gm_json_end(json);
    }
    gm_json_end(json);
}

void gm_checked_gearset_json(const gm_checked_gearset *checked, gm_json *json)
{
    const gm_description *d = checked->description;
    gm_json_text(json, "name", d->name);
    gm_json_text(json, "title", d->title);
    gm_json_text(json, "file", d->file);
    gm_json_text(json, "sha256", d->sha256);
    gm_json_number(json, "oil_temperature_degC", checked->oil_temperature - KELVIN);
    gm_json_text(json, "output", d->shafts[d->output].id.name);
    gm_json_number(json, "input_speed_max_rpm", d->speed_max * RPM_PER_RAD_S);
    gm_json_number(json, "input_torque_max_Nm", d->torque_max);
    gm_json_number(json, "inertia_output_kgm2", checked->inertia_output);
    shafts_json(d, json);
    paths_json(checked, json);
}
