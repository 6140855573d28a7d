/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: what the gearset is made for, and its oil.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

#define OWNER gm_description
static const gm_field limit_fields[] = {
    {NUMBER("input_speed_max_rpm", 10, 100000), AT(speed_max),
     .help = "largest input speed; the default sweep goes up to it"},
    {NUMBER("input_torque_max_Nm", 0, 100000), ABOVE, AT(torque_max),
     .help = "largest input torque; the default sweep goes up to it"},
    END};
const gm_section gm_schema_limit = {
    .title = "limits", .word = "limits", .help = "What the gearset is made for.",
    .fields = limit_fields};
#undef OWNER

#define OWNER gm_oil_part
static const gm_field oil_fields[] = {
    {.key = "name", .type = GM_FIELD_WORDS, OPTIONAL, AT(name), .help = "for people"},
    {NUMBER("viscosity_40_mm2_s", 2, 10000), AT(viscosity_40),
     .help = "kinematic viscosity at 40 degC"},
    {NUMBER("viscosity_100_mm2_s", 1, 1000), AT(viscosity_100),
     .help = "kinematic viscosity at 100 degC"},
    {NUMBER("third_viscosity_mm2_s", 1, 1e6), AT(third_viscosity), OPTIONAL,
     .help = "kinematic viscosity at third_temperature_degC; with it the curve is "
             "Vogel's through all three, without it that of ASTM D341"},
    {NUMBER("third_temperature_degC", -40, 200), AT(third_temperature), OPTIONAL,
     .help = "where third_viscosity_mm2_s holds, at least 5 K from 40 and 100 degC"},
    {NUMBER("density_15_kg_m3", 500, 1500), AT(density_15), .help = "density at 15 degC"},
    {NUMBER("thermal_expansion_1_K", 0, 0.01), AT(thermal_expansion), DEFAULT("7e-4"),
     .help = "alpha in rho = rho_15 (1 - alpha (T - 15 degC))"},
    {NUMBER("temperature_degC", -40, 160), AT(temperature), DEFAULT("80"),
     .help = "oil temperature at which the gearset is computed"},
    {NUMBER("mesh_lubricant_factor", 0, 3), ABOVE, AT(mesh_lubricant_factor),
     DEFAULT("1"),
     .help = "X_L of ISO/TR 14179-2: 1 mineral oil, 0.8 synthetic hydrocarbon, "
             "0.75 a 75W transmission oil"},
    {NUMBER("bearing_mu_ehl", 0, 0.2), ABOVE, AT(bearing_mu_ehl), DEFAULT("0.05"),
     .help = "sliding friction of rolling bearings in full film (SKF): 0.05 mineral oil, "
             "0.04 synthetic oil, 0.1 transmission fluids"},
    {NUMBER("level_mm", -5000, 5000), AT(level), OPTIONAL,
     .help = "z of the oil's surface at rest; without it there is no churning"},
    {NUMBER("volume_l", 0, 1000), ABOVE, AT(volume), DEFAULT("1"), .help = "oil fill"},
    END};
const gm_section gm_schema_oil = {
    .title = "oil", .word = "oil", .help = "The lubricant of all parts.",
    .fields = oil_fields};
#undef OWNER
/* clang-format on */
