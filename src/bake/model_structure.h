/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The element ModelStructure of modelDescription.xml.
 */
#ifndef MODEL_STRUCTURE_H
#define MODEL_STRUCTURE_H

#include "bake/xml.h"

/** Write outputs, derivatives and initial unknowns with their exact dependencies. */
void gm_model_structure_write(xml *x);

#endif
