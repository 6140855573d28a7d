/* SPDX-License-Identifier: BSD-2-Clause */
#include "planetary_fixture.h"

#include "description_fixture.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

GM_PRINTF(2, 3)
static void add(planetary_text *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(t->text + t->used, t->size - t->used, format, args);
    va_end(args);
    assert(n > 0 && (size_t)n < t->size - t->used);
    t->used += (size_t)n;
}

void planetary_begin(planetary_text *t, char *text, size_t size)
{
    *t = (planetary_text){.text = text, .size = size};
    add(t, "format: 1\nname: planetary\n"
           "limits: {input_speed_max_rpm: 6000, input_torque_max_Nm: 300}\n"
           "oil: {viscosity_40_mm2_s: 30.8, viscosity_100_mm2_s: 5.9, "
           "density_15_kg_m3: 845,\n      mesh_lubricant_factor: 0.75}\n");
}

void planetary_shafts(planetary_text *t, const char *const *names)
{
    add(t, "shafts:\n");
    for (int i = 0; names[i]; i++)
        add(t,
            "  %s: {y_mm: 0, z_mm: 0, inertia_kgm2: %g, mass_kg: 1,\n"
            "       segments: [{from_mm: 0, to_mm: 300, diameter_mm: 20}]}\n",
            names[i], 1e-3 * (1 + i));
}

void planetary_gears(planetary_text *t)
{
    add(t, "gears:\n");
}

void planetary_add_mesh(planetary_text *t, const char *name, const char *a, const char *b)
{
    char loss[80] = "";
    size_t n = strlen(t->meshes);
    if (t->efficiency > 0.0)
        (void)snprintf(loss, sizeof loss, ", loss: {model: constant, efficiency: %.17g}",
                       t->efficiency);
    int wrote = snprintf(t->meshes + n, sizeof t->meshes - n,
                         "  %s: {gears: [%s, %s]%s}\n", name, a, b, loss);
    assert(wrote > 0 && (size_t)wrote < sizeof t->meshes - n);
    (void)wrote;
}

void planetary_add_set(planetary_text *t, const planetary_set *s)
{
    char planet[48], other[48], mesh[48];
    const char *body = "normal_module_mm: 2, width_mm: 20";
    (void)snprintf(planet, sizeof planet, "%s_planet", s->name);
    add(t, "  %s_sun: {shaft: %s, teeth: %d, %s, position_mm: %g}\n", s->name, s->sun,
        s->z_sun, body, s->position);
    add(t,
        "  %s: {shaft: %s, teeth: %d, %s, position_mm: %g, idles: true, planets: %d,\n"
        "    pin_radius_mm: %.9g, bearing: {type: needle_roller, bore_mm: 8, outer_mm: "
        "10,"
        "\n    width_mm: 12, friction: %s}}\n",
        planet, s->carrier, (s->z_ring - s->z_sun) / 2, body, s->position, s->planets,
        0.5 * (s->z_ring + s->z_sun), t->friction ? "skf" : "none");
    add(t,
        "  %s_ring: {shaft: %s, teeth: %d, %s, position_mm: %g, internal: true,\n"
        "    inertia_kgm2: 0.01, mass_kg: 2}\n",
        s->name, s->ring, s->z_ring, body, s->position);
    (void)snprintf(other, sizeof other, "%s_sun", s->name);
    (void)snprintf(mesh, sizeof mesh, "%s_inner", s->name);
    planetary_add_mesh(t, mesh, other, planet);
    (void)snprintf(other, sizeof other, "%s_ring", s->name);
    (void)snprintf(mesh, sizeof mesh, "%s_outer", s->name);
    planetary_add_mesh(t, mesh, planet, other);
}

void planetary_add(planetary_text *t, const char *line)
{
    add(t, "%s\n", line);
}

void planetary_end(planetary_text *t, const char *const *names, const char *rest)
{
    const char *friction = t->friction ? "skf" : "none";
    add(t, "meshes:\n%sbearings:\n", t->meshes);
    for (int i = 0; names[i]; i++)
        add(t,
            "  %s_front: {shaft: %s, position_mm: 10, locating: true,\n"
            "    type: deep_groove_ball, designation: \"6204\", friction: %s}\n"
            "  %s_rear: {shaft: %s, position_mm: 290,\n"
            "    type: deep_groove_ball, designation: \"6204\", friction: %s}\n",
            names[i], names[i], friction, names[i], names[i], friction);
    add(t, "%s", rest);
}

gm_description *planetary_read(const planetary_text *t, const char *file)
{
    gm_test_spill(file, t->text);
    return gm_test_read(file);
}
