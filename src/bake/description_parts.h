/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Parts of modelDescription.xml that reduced and detailed components have in common.
 */
#ifndef DESCRIPTION_PARTS_H
#define DESCRIPTION_PARTS_H

#include "bake/xml.h"

/** Type of a path's gears: "OddGear" for path "odd". */
void gm_gear_type_name(const xml *x, int p, char name[32]);

/** UnitDefinitions, TypeDefinitions and LogCategories with these n units. */
void gm_describe_types(xml *x, const unit_type *units, int n);

/** generationDateAndTime, where SOURCE_DATE_EPOCH says it. */
void gm_describe_date(xml *x);

/** DefaultExperiment. */
void gm_describe_experiment(xml *x);

/** The annotation that says what the component was made from (the map's input, and its
 *  content where it has one), and what gears it has. */
void gm_describe_origin(xml *x);

/** How a variable differs from what core/gm_vars.def says. */
typedef struct scalar_form {
    double nominal;          /* 0: the list's */
    bool algebraic;          /* no state and no derivative; without a start value */
    const char *description; /* NULL: the list's */
} scalar_form;

/** The ScalarVariable of s. */
void gm_describe_scalar(xml *x, scalar s, const scalar_form *form);

#endif
