/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Dimensions and static load ratings of single row deep groove ball bearings by
 * designation. Source: SKF, Rolling bearings (General Catalogue 10000); boundary
 * dimensions ISO 15, ratings ISO 76.
 *
 * The designation is the series and two digits for the bore: "6206" is series 62,
 * "61906" series 619.
 */
#include "model/bearing.h"

#include "base/text.h"

#include <string.h>

typedef struct catalogue_row {
    const char *designation;
    double d, D, B; /* mm */
    double C0;      /* N */
} catalogue_row;

// clang-format off
static const catalogue_row catalogue[] = {
    {"6203",    17.,   40.,   12.,    4750.},
    {"6303",    17.,   47.,   14.,    6550.},
    {"6004",    20.,   42.,   12.,    5000.},
    {"6204",    20.,   47.,   14.,    6550.},
    {"6304",    20.,   52.,   15.,    7800.},
    {"16005",   25.,   47.,    8.,    4750.},
    {"6005",    25.,   47.,   12.,    6550.},
    {"6205",    25.,   52.,   15.,    7800.},
    {"6305",    25.,   62.,   17.,   11600.},
    {"61906",   30.,   47.,    9.,    4550.},
    {"16006",   30.,   55.,    9.,    7350.},
    {"6006",    30.,   55.,   13.,    8300.},
    {"6206",    30.,   62.,   16.,   11200.},
    {"6306",    30.,   72.,   19.,   16000.},
    {"6007",    35.,   62.,   14.,   10200.},
    {"6207",    35.,   72.,   17.,   15300.},
    {"6307",    35.,   80.,   21.,   19000.},
    {"61908",   40.,   62.,   12.,   10000.},
    {"16008",   40.,   62.,    9.,   10200.},
    {"6008",    40.,   68.,   15.,   11000.},
    {"6208",    40.,   80.,   18.,   19000.},
    {"6308",    40.,   90.,   23.,   24000.},
    {"6009",    45.,   75.,   16.,   14600.},
    {"6209",    45.,   85.,   19.,   21600.},
    {"6010",    50.,   80.,   16.,   16000.},
};
// clang-format on

enum { n_catalogue = sizeof catalogue / sizeof catalogue[0] };

static gm_status unknown_designation(const char *designation, gm_error *error)
{
    const char *names[n_catalogue];
    for (int i = 0; i < n_catalogue; i++)
        names[i] = catalogue[i].designation;
    int near = gm_text_nearest(designation, names, n_catalogue);
    return gm_fail(error, GM_ERR_MODEL, "the catalogue has no bearing \"%s\"%s%s%s",
                   designation,
                   near >= 0 ? "; did you mean \"" : "; give its dimensions instead",
                   near >= 0 ? names[near] : "", near >= 0 ? "\"?" : "");
}

static void fill(gm_bearing_data *data, const catalogue_row *row)
{
    size_t n_series = strlen(row->designation) - 2;
    memcpy(data->series, row->designation, n_series);
    data->series[n_series] = '\0';
    data->d = 1e-3 * row->d;
    data->D = 1e-3 * row->D;
    data->B = 1e-3 * row->B;
    data->C0 = row->C0;
}

gm_status gm_bearing_data_complete(gm_bearing_data *data, gm_error *error)
{
    if (data->type != GM_BEARING_DEEP_GROOVE_BALL)
        return gm_fail(
            error, GM_ERR_MODEL,
            "the catalogue has deep groove ball bearings only: give dimensions "
            "and series of the %s \"%s\" instead of its designation",
            gm_bearing_type_name(data->type), data->designation);
    for (int i = 0; i < n_catalogue; i++)
        if (strcmp(catalogue[i].designation, data->designation) == 0) {
            fill(data, &catalogue[i]);
            return GM_OK;
        }
    return unknown_designation(data->designation, error);
}
