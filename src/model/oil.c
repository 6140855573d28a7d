/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Viscosity of oil over temperature: Walther's equation, ASTM D341 / DIN 51563 with the
 * constant c = 0.8,
 *
 *   log10 log10 (nu + 0.8) = A - B log10 T,      nu in mm2/s, T in K,
 *
 * A and B from the viscosities at 40 and 100 degC. Valid for about -20 to 150 degC and
 * nu >= 2 mm2/s (below, D341 adds terms that are left out here). Density falls linearly:
 * rho = rho_15 (1 - alpha (T - 15 degC)).
 */
#include "model/oil.h"

#include <math.h>

static const double kelvin = 273.15;
static const double constant_c = 0.8; /* mm2/s */

/* Walther's ordinate; nu in mm2/s, nu + c > 1. */
static double ordinate(double nu)
{
    return log10(log10(nu + constant_c));
}

double gm_oil_viscosity(double nu_40, double nu_100, double temperature)
{
    double w_40 = ordinate(1e6 * nu_40), w_100 = ordinate(1e6 * nu_100);
    double t_40 = log10(kelvin + 40.), t_100 = log10(kelvin + 100.);
    double B = (w_40 - w_100) / (t_100 - t_40);
    double A = w_100 + B * t_100;
    return 1e-6 * (pow(10., pow(10., A - B * log10(temperature))) - constant_c);
}

gm_oil gm_oil_at(const gm_oil_part *part, double temperature)
{
    double warmer = temperature - (kelvin + 15.);
    gm_oil oil = {.nu_40 = part->viscosity_40,
                  .temperature = temperature,
                  .mesh_lubricant_factor = part->mesh_lubricant_factor,
                  .bearing_mu_ehl = part->bearing_mu_ehl};
    oil.nu = gm_oil_viscosity(part->viscosity_40, part->viscosity_100, temperature);
    oil.rho = part->density_15 * (1. - part->thermal_expansion * warmer);
    oil.eta = oil.nu * oil.rho;
    return oil;
}
