/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Geometry constants of the SKF friction model, and the constants K_Z and K_L.
 * Source: SKF, Rolling bearings (General Catalogue 10000), "The SKF model for calculating
 * the frictional moment", tables of the constants for rolling and sliding frictional
 * moments and of K_Z. Mixed units of the model: N, mm, N.mm, rpm. Empty places are 0.
 *
 * R_1, S_1 scale the rolling and sliding moment, R_2, S_2 weigh the axial load, R_3, S_3
 * the centrifugal force of the balls.
 */
#include "model/bearing_models.h"

#include "base/text.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define COUNT(table) ((int)(sizeof(table) / sizeof((table)[0])))

// clang-format off
/*    series           R_1       R_2    R_3       S_1       S_2     S_3       K_Z   K_L */
static const gm_skf_row deep_groove_ball[] = {
    {"2",             4.4e-7,   1.7,   0.,       2.00e-3,  100.,   0.,       3.1,  0.},
    {"3",             4.4e-7,   1.7,   0.,       2.00e-3,  100.,   0.,       3.1,  0.},
    {"42",            5.4e-7,   0.96,  0.,       3.00e-3,  40.,    0.,       3.1,  0.},
    {"43",            5.4e-7,   0.96,  0.,       3.00e-3,  40.,    0.,       3.1,  0.},
    {"60",            4.1e-7,   1.7,   0.,       3.73e-3,  14.6,   0.,       3.1,  0.},
    {"630",           4.1e-7,   1.7,   0.,       3.73e-3,  14.6,   0.,       3.1,  0.},
    {"62",            3.9e-7,   1.7,   0.,       3.23e-3,  36.5,   0.,       3.1,  0.},
    {"622",           3.9e-7,   1.7,   0.,       3.23e-3,  36.5,   0.,       3.1,  0.},
    {"63",            3.7e-7,   1.7,   0.,       2.84e-3,  92.8,   0.,       3.1,  0.},
    {"623",           3.7e-7,   1.7,   0.,       2.84e-3,  92.8,   0.,       3.1,  0.},
    {"64",            3.6e-7,   1.7,   0.,       2.43e-3,  198.,   0.,       3.1,  0.},
    {"160",           4.3e-7,   1.7,   0.,       4.63e-3,  4.25,   0.,       3.1,  0.},
    {"161",           4.3e-7,   1.7,   0.,       4.63e-3,  4.25,   0.,       3.1,  0.},
    {"617",           4.7e-7,   1.7,   0.,       6.50e-3,  0.78,   0.,       3.1,  0.},
    {"618",           4.7e-7,   1.7,   0.,       6.50e-3,  0.78,   0.,       3.1,  0.},
    {"628",           4.7e-7,   1.7,   0.,       6.50e-3,  0.78,   0.,       3.1,  0.},
    {"637",           4.7e-7,   1.7,   0.,       6.50e-3,  0.78,   0.,       3.1,  0.},
    {"638",           4.7e-7,   1.7,   0.,       6.50e-3,  0.78,   0.,       3.1,  0.},
    {"619",           4.3e-7,   1.7,   0.,       4.75e-3,  3.6,    0.,       3.1,  0.},
    {"639",           4.3e-7,   1.7,   0.,       4.75e-3,  3.6,    0.,       3.1,  0.},
};

/*    series           R_1       R_2    R_3       S_1       S_2     S_3       K_Z   K_L */
static const gm_skf_row angular_contact_ball[] = {
    {"72xx BECBP",    4.33e-7,  2.02,  2.44e-12, 1.82e-2,  0.71,   2.44e-12, 4.4,  0.},
    {"73xx BECBP",    4.54e-7,  2.02,  1.84e-12, 1.64e-2,  0.71,   1.84e-12, 4.4,  0.},
    {"72xx ACCBM",    3.58e-7,  3.64,  3.55e-12, 1.14e-2,  1.55,   3.55e-12, 4.4,  0.},
    {"73xx ACCBM",    3.48e-7,  3.64,  1.66e-12, 9.85e-3,  1.55,   1.66e-12, 4.4,  0.},
    {"32xx A",        5.18e-7,  1.63,  4.18e-12, 1.08e-2,  1.47,   4.18e-12, 3.1,  0.},
    {"33xx A",        5.31e-7,  1.63,  8.83e-13, 5.48e-3,  1.47,   8.83e-13, 3.1,  0.},
    {"four_point",    4.78e-7,  2.42,  1.40e-12, 1.20e-2,  0.9,    1.40e-12, 3.1,  0.},
};

/*    series           R_1       R_2    R_3       S_1       S_2     S_3       K_Z   K_L */
static const gm_skf_row cylindrical_roller[] = {
    {"2",             1.09e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"3",             1.09e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"4",             1.00e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"10",            1.12e-6,  0.,    0.,       0.17,     0.0015, 0.,       5.1,  0.65},
    {"12",            1.23e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"20",            1.23e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"22",            1.40e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"23",            1.48e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"22_high_cap",   1.54e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"23_high_cap",   1.63e-6,  0.,    0.,       0.16,     0.0015, 0.,       5.1,  0.65},
    {"all_full_comp", 2.13e-6,  0.,    0.,       0.16,     0.0015, 0.,       6.2,  0.7},
};

/*    series           R_1       R_2    R_3       S_1       S_2     S_3       K_Z   K_L */
static const gm_skf_row tapered_roller[] = {
    {"302",           1.76e-6,  10.9,  0.,       0.017,    2.,     0.,       6.0,  0.7},
    {"303",           1.69e-6,  10.9,  0.,       0.017,    2.,     0.,       6.0,  0.7},
    {"313 X",         1.84e-6,  10.9,  0.,       0.048,    2.,     0.,       6.0,  0.7},
    {"320 X",         2.38e-6,  10.9,  0.,       0.014,    2.,     0.,       6.0,  0.7},
    {"322",           2.27e-6,  10.9,  0.,       0.018,    2.,     0.,       6.0,  0.7},
    {"322 B",         2.38e-6,  10.9,  0.,       0.026,    2.,     0.,       6.0,  0.7},
    {"323",           2.38e-6,  10.9,  0.,       0.019,    2.,     0.,       6.0,  0.7},
    {"323 B",         2.79e-6,  10.9,  0.,       0.030,    2.,     0.,       6.0,  0.7},
    {"329",           2.31e-6,  10.9,  0.,       0.009,    2.,     0.,       6.0,  0.7},
    {"330",           2.71e-6,  11.3,  0.,       0.010,    2.,     0.,       6.0,  0.7},
    {"331",           2.71e-6,  10.9,  0.,       0.015,    2.,     0.,       6.0,  0.7},
    {"332",           2.71e-6,  10.9,  0.,       0.018,    2.,     0.,       6.0,  0.7},
    {"LL",            1.72e-6,  10.9,  0.,       0.0057,   2.,     0.,       6.0,  0.7},
    {"L",             2.19e-6,  10.9,  0.,       0.0093,   2.,     0.,       6.0,  0.7},
    {"LM",            2.25e-6,  10.9,  0.,       0.011,    2.,     0.,       6.0,  0.7},
    {"M",             2.48e-6,  10.9,  0.,       0.015,    2.,     0.,       6.0,  0.7},
    {"HM",            2.60e-6,  10.9,  0.,       0.020,    2.,     0.,       6.0,  0.7},
    {"H",             2.66e-6,  10.9,  0.,       0.025,    2.,     0.,       6.0,  0.7},
    {"HH",            2.51e-6,  10.9,  0.,       0.027,    2.,     0.,       6.0,  0.7},
    {"all_other",     2.31e-6,  10.9,  0.,       0.019,    2.,     0.,       6.0,  0.7},
};

// clang-format on

const gm_skf_row *gm_skf_rows(gm_bearing_type type, int *n)
{
    switch (type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        *n = COUNT(deep_groove_ball);
        return deep_groove_ball;
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        *n = COUNT(angular_contact_ball);
        return angular_contact_ball;
    case GM_BEARING_TAPERED_ROLLER:
        *n = COUNT(tapered_roller);
        return tapered_roller;
    case GM_BEARING_CYLINDRICAL_ROLLER:
    case GM_BEARING_NEEDLE_ROLLER:
    case GM_BEARING_PLAIN: /* asked by nobody */
        break;
    }
    *n = COUNT(cylindrical_roller);
    return cylindrical_roller;
}

static bool same_name(const char *a, const char *b)
{
    for (;;) {
        while (*a == ' ')
            a++;
        while (*b == ' ')
            b++;
        if (tolower((unsigned char)*a) != tolower((unsigned char)*b))
            return false;
        if (*a == '\0')
            return true;
        a++;
        b++;
    }
}

#define MAX_ROWS 32

/* "..., did you mean X?" or, where nothing is near, all the names. */
static gm_status unknown_series(gm_bearing_type type, const char *series,
                                const gm_skf_row *rows, int n, gm_error *error)
{
    const char *names[MAX_ROWS];
    char known[512] = "";
    size_t used = 0;
    for (int i = 0; i < n && i < MAX_ROWS && used < sizeof known; i++) {
        names[i] = rows[i].series;
        int length = snprintf(known + used, sizeof known - used, "%s%s",
                              i > 0 ? ", " : "", names[i]);
        used += length > 0 ? (size_t)length : 0;
    }
    const char *kind = gm_bearing_type_name(type);
    if (series[0] == '\0')
        return gm_fail(error, GM_ERR_MODEL,
                       "a %s with friction skf needs its series: one of %s", kind, known);
    int near = gm_text_nearest(series, names, n < MAX_ROWS ? n : MAX_ROWS);
    if (near >= 0)
        return gm_fail(error, GM_ERR_MODEL,
                       "the SKF friction tables have no series \"%s\" of %ss; did you "
                       "mean \"%s\"?",
                       series, kind, names[near]);
    return gm_fail(error, GM_ERR_MODEL,
                   "the SKF friction tables have no series \"%s\" of %ss; known are %s",
                   series, kind, known);
}

gm_status gm_skf_find(gm_bearing_type type, const char *series, const gm_skf_row **row,
                      gm_error *error)
{
    int n;
    const gm_skf_row *rows = gm_skf_rows(type, &n);
    const char *name = type == GM_BEARING_NEEDLE_ROLLER ? "all_full_comp" : series;
    for (int i = 0; i < n; i++)
        if (same_name(rows[i].series, name)) {
            *row = &rows[i];
            return GM_OK;
        }
    return unknown_series(type, series, rows, n, error);
}
