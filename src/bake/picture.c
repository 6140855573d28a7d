/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Fields stand in rows, in the order of the gears; a label in each names its gear. The
 * colours run from dark violet over blue-green to yellow with rising brightness, so that
 * the picture reads in grey too; the anchors are those of the palette "viridis"
 * (N. Smith, S. van der Walt, public domain, CC0).
 */
#include "bake/picture.h"

#include "bake/png.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

enum {
    FIELD = 72,  /* pixels, width and height */
    GAP = 6,     /* between fields and around them */
    SHADES = 64, /* of the scale */
    PAPER = SHADES,
    INK,
    COLOURS,
    GLYPH_WIDTH = 5,
    GLYPH_HEIGHT = 7,
    ZOOM = 2 /* of a label */
};

/* ---- numbers ---- */

/* The configuration with this gear and the other path in neutral; where it is never in
 * neutral, the first with this gear. */
static const gm_configuration *configuration_of(const gm_reduced_map *map, int p, int g)
{
    const gm_configuration *found = NULL;
    for (int i = 0; i < map->n_configurations; i++) {
        const gm_configuration *c = &map->configurations[i];
        bool alone = map->n_paths == 1 || c->gear[1 - p] < 0;
        bool possible = c->parasitic[GM_FORWARD].value != NULL;
        if (c->gear[p] == g && possible && (!found || alone))
            found = c;
    }
    return found;
}

/* The one nearest to the usual oil temperature. */
static int usual_slice(const gm_reduced_map *map)
{
    int slice = 0;
    for (int k = 1; k < map->oil.n; k++)
        if (fabs(map->oil.temperature[k] - map->oil_temperature) <
            fabs(map->oil.temperature[slice] - map->oil_temperature))
            slice = k;
    return slice;
}

double gm_picture_efficiency(const gm_reduced_map *map, int p, int g, double w,
                             double tau)
{
    const gm_gear *gear = &map->path[p].gears[g];
    const gm_configuration *c = configuration_of(map, p, g);
    double ratio = gear->ratio < 0 ? -gear->ratio : gear->ratio;
    /* the output turns forward: with a negative ratio the path turns backward */
    int direction = gear->ratio < 0 ? GM_BACKWARD : GM_FORWARD;
    const int slice = usual_slice(map);
    gm_table2 loads = gear->load_loss[direction];
    gm_table1 drags = c->parasitic[GM_FORWARD];
    gm_cell1 cell1 = {0};
    gm_cell2 cell2 = {0};
    loads.value += slice * loads.x.n * loads.y.n;
    drags.value += slice * drags.x.n;
    double load = gm_table2_at(&loads, 1, &cell2, w, tau).value;
    double parasitic = gm_table1_at(&drags, 1, &cell1, w / ratio).value;
    double efficiency = 1 - (load + parasitic / ratio) / tau;
    return efficiency > 0 ? efficiency : 0;
}

void gm_picture_colour(double efficiency, unsigned char rgb[3])
{
    static const unsigned char anchor[][3] = {
        {68, 1, 84},    {70, 50, 127},  {54, 92, 141},  {39, 127, 142},
        {31, 161, 135}, {74, 194, 109}, {159, 218, 58}, {253, 231, 37}};
    enum { LAST = sizeof anchor / sizeof *anchor - 1 };
    double at = (efficiency - GM_PICTURE_LOW) / (GM_PICTURE_HIGH - GM_PICTURE_LOW);
    at = LAST * (at < 0 ? 0 : at > 1 ? 1 : at);
    int i = at >= LAST ? LAST - 1 : (int)at;
    for (int k = 0; k < 3; k++)
        rgb[k] = (unsigned char)(anchor[i][k] +
                                 (at - i) * (anchor[i + 1][k] - anchor[i][k]) + 0.5);
}

/* Middle of a shade of the scale. */
static double efficiency_of(int shade)
{
    return GM_PICTURE_LOW + (GM_PICTURE_HIGH - GM_PICTURE_LOW) * (shade + 0.5) / SHADES;
}

static unsigned char shade_of(double efficiency)
{
    double at =
        SHADES * (efficiency - GM_PICTURE_LOW) / (GM_PICTURE_HIGH - GM_PICTURE_LOW);
    return (unsigned char)(at < 0 ? 0 : at >= SHADES ? SHADES - 1 : at);
}

/* ---- the picture ---- */

static void set_colours(gm_picture *picture)
{
    static const unsigned char paper[3] = {255, 255, 255}, ink[3] = {255, 255, 255};
    for (int i = 0; i < SHADES; i++)
        gm_picture_colour(efficiency_of(i), picture->colour[i]);
    memcpy(picture->colour[PAPER], paper, 3);
    memcpy(picture->colour[INK], ink, 3);
    picture->n_colours = COLOURS;
    picture->clear = PAPER;
}

/* Rows of dots, most significant bit left; digits and R. */
static void draw_glyph(gm_picture *picture, int x, int y, char c)
{
    static const char known[] = "0123456789R";
    static const unsigned char dots[][GLYPH_HEIGHT] = {
        {14, 17, 19, 21, 25, 17, 14}, {4, 12, 4, 4, 4, 4, 14},
        {14, 17, 1, 2, 4, 8, 31},     {31, 2, 4, 2, 1, 17, 14},
        {2, 6, 10, 18, 31, 2, 2},     {31, 16, 30, 1, 1, 17, 14},
        {6, 8, 16, 30, 17, 17, 14},   {31, 1, 2, 4, 8, 8, 8},
        {14, 17, 17, 14, 17, 17, 14}, {14, 17, 17, 15, 1, 2, 12},
        {30, 17, 17, 30, 20, 18, 17}};
    const char *at = strchr(known, c);
    if (!at || !c)
        return;
    for (int i = 0; i < ZOOM * GLYPH_HEIGHT; i++)
        for (int j = 0; j < ZOOM * GLYPH_WIDTH; j++)
            if (dots[at - known][i / ZOOM] >> (GLYPH_WIDTH - 1 - j / ZOOM) & 1)
                picture->pixel[(y + i) * picture->width + x + j] = INK;
}

/* "R", "3", "12" in the lower right corner, where efficiency is low or falls. */
static void draw_label(gm_picture *picture, int x, int y, int gear)
{
    char text[3] = {'R', '\0', '\0'};
    int n = 1;
    if (gear >= 0) {
        n = gear >= 10 ? 2 : 1;
        text[0] = (char)('0' + (n == 2 ? gear / 10 % 10 : gear));
        text[1] = (char)('0' + gear % 10);
    }
    for (int i = 0; i < n; i++)
        draw_glyph(picture, x + FIELD - 4 - ZOOM * (GLYPH_WIDTH + 1) * (n - i),
                   y + FIELD - 5 - ZOOM * GLYPH_HEIGHT, text[i]);
}

static void draw_field(gm_picture *picture, int x, int y, const gm_map *map,
                       const gm_reduced_map *reduced, int p, int g)
{
    for (int i = 0; i < FIELD; i++)
        for (int j = 0; j < FIELD; j++) {
            double w = map->speed_max * (j + 0.5) / FIELD;
            double up = (FIELD - i - 0.5) / FIELD, tau = map->torque_max * up * up;
            picture->pixel[(y + i) * picture->width + x + j] =
                shade_of(gm_picture_efficiency(reduced, p, g, w, tau));
        }
    draw_label(picture, x, y, map->paths[p].gears[g].number);
}

/* The k-th gear in the order of the numbers, reverse last; paths take turns. */
static void find_gear(const gm_map *map, int k, int *path, int *gear)
{
    for (int number = 1; number <= GM_MAP_ANY; number++)
        for (int p = 0; p < map->n_paths; p++)
            for (int g = 0; g < map->paths[p].n_gears; g++) {
                int n = map->paths[p].gears[g].number;
                if ((n == number || (n < 0 && number == GM_MAP_ANY)) && k-- == 0) {
                    *path = p;
                    *gear = g;
                    return;
                }
            }
}

/* As square as it gets. */
static int columns_for(int n)
{
    int columns = 1;
    while (columns * columns < n)
        columns++;
    return columns;
}

gm_status gm_picture_write(const gm_map *map, const gm_reduced_map *reduced,
                           gm_buffer *buffer, gm_error *error)
{
    int n = 0;
    for (int p = 0; p < map->n_paths; p++)
        n += map->paths[p].n_gears;
    int columns = columns_for(n), rows = n > 0 ? (n + columns - 1) / columns : 1;
    gm_picture picture = {.width = GAP + columns * (FIELD + GAP),
                          .height = GAP + rows * (FIELD + GAP)};
    size_t size = (size_t)picture.width * (size_t)picture.height;
    picture.pixel = gm_calloc(size, 1);
    if (!picture.pixel)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the picture");
    memset(picture.pixel, PAPER, size);
    set_colours(&picture);
    for (int k = 0; k < n; k++) {
        int p = 0, g = 0;
        find_gear(map, k, &p, &g);
        draw_field(&picture, GAP + k % columns * (FIELD + GAP),
                   GAP + k / columns * (FIELD + GAP), map, reduced, p, g);
    }
    gm_png_write(&picture, buffer);
    gm_free(picture.pixel);
    return buffer->failed ? gm_fail(error, GM_ERR_MEMORY, "no memory for the picture")
                          : GM_OK;
}
