/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Viscosity of oil over temperature: Walther's equation, ASTM D341 / DIN 51563 with the
 * constant c = 0.8,
 *
 *   log10 log10 (nu + 0.8) = A - B log10 T,      nu in mm2/s, T in K,
 *
 * A and B from the viscosities at 40 and 100 degC. Valid for about -20 to 150 degC and
 * nu >= 2 mm2/s (below, D341 adds terms that are left out here).
 *
 * With a third viscosity, for oils far from a straight line in those coordinates and for
 * the cold: Vogel's equation (Physikalische Zeitschrift 22, 1921, 645)
 *
 *   ln nu = A + B / (T + C),                     nu in mm2/s, T in degC,
 *
 * through all three. With T_3 and L = ln nu,
 *
 *   (100 + C) / (40 + C) = q = (L_40 - L_3) (100 - T_3) / ((L_3 - L_100) (T_3 - 40)).
 *
 * Beyond the three points it is an extrapolation.
 *
 * Density falls linearly: rho = rho_15 (1 - alpha (T - 15 degC)).
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

/* The pole at -C stays 20 K below the coldest oil allowed. */
static const double coldest_pole = -60.;

bool gm_oil_vogel(const gm_oil_part *part, gm_vogel *vogel)
{
    double T = part->third_temperature - kelvin, L = log(1e6 * part->third_viscosity);
    double L_40 = log(1e6 * part->viscosity_40), L_100 = log(1e6 * part->viscosity_100);
    double q = (L_40 - L) * (100. - T) / ((L - L_100) * (T - 40.));
    if (!(q > 1. && q < (100. - coldest_pole) / (40. - coldest_pole)))
        return false;
    double C = (100. - 40. * q) / (q - 1.);
    double B = (L_40 - L_100) * (40. + C) * (100. + C) / 60.;
    *vogel = (gm_vogel){L_40 - B / (40. + C), B, C};
    return true;
}

static double viscosity(const gm_oil_part *part, double temperature)
{
    gm_vogel v;
    if (part->third_viscosity > 0. && gm_oil_vogel(part, &v))
        return 1e-6 * exp(v.A + v.B / (temperature - kelvin + v.C));
    return gm_oil_viscosity(part->viscosity_40, part->viscosity_100, temperature);
}

gm_oil gm_oil_at(const gm_oil_part *part, double temperature)
{
    double warmer = temperature - (kelvin + 15.);
    gm_oil oil = {.nu_40 = part->viscosity_40,
                  .temperature = temperature,
                  .mesh_lubricant_factor = part->mesh_lubricant_factor,
                  .bearing_mu_ehl = part->bearing_mu_ehl};
    oil.nu = viscosity(part, temperature);
    oil.rho = part->density_15 * (1. - part->thermal_expansion * warmer);
    oil.eta = oil.nu * oil.rho;
    return oil;
}
