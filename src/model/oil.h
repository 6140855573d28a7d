/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Oil at one temperature. Viscosity by Walther (ASTM D341, c = 0.8), through the values
 * at 40 and 100 degC, or by Vogel, through a third value as well; density by a linear
 * law.
 */
#ifndef OIL_H
#define OIL_H

#include "model/gm_description.h"

#include <stdbool.h>

typedef struct gm_oil {
    double nu;          /* kinematic viscosity, m2/s */
    double rho;         /* density, kg/m3 */
    double eta;         /* dynamic viscosity, Pa.s */
    double nu_40;       /* kinematic viscosity at 40 degC, m2/s */
    double temperature; /* K */
    double mesh_lubricant_factor;
    double bearing_mu_ehl;
} gm_oil;

/** nu [m2/s] at temperature [K] from the values at 40 and 100 degC (ASTM D341).
 *  Valid for about -20 to 150 degC and nu >= 2 mm2/s. */
double gm_oil_viscosity(double nu_40, double nu_100, double temperature);

/** Vogel's equation ln nu = A + B / (T + C), nu in mm2/s, T in degC. */
typedef struct gm_vogel {
    double A, B, C;
} gm_vogel;

/** Through the three values of the part, whose third is given. False, *vogel untouched:
 *  no such curve falls and has its pole below -60 degC. */
bool gm_oil_vogel(const gm_oil_part *part, gm_vogel *vogel);

/** Oil of the description at a temperature [K]; the part is checked. */
gm_oil gm_oil_at(const gm_oil_part *part, double temperature);

#endif
