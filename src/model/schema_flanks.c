/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: what happens between flanks, of meshes and of the
 * dogs of synchronisers. Only motion over time and compliance look at them; in steady
 * motion flanks lie against each other.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

static const gm_choice contact_models[] = {{"film", GM_CONTACT_FILM},
                                           {"dry", GM_CONTACT_DRY},
                                           {NULL, 0}};

#define OWNER gm_flanks
static const gm_field flank_fields[] = {
    {.key = "contact", .type = GM_FIELD_CHOICE, .choices = contact_models, AT(model),
     DEFAULT("film"),
     .help = "film: an oil film is squeezed, contact is entered softly; dry: no force in "
             "the gap and no pull when flanks part"},
    {NUMBER("stiffness_N_um", 0, 1e6), ABOVE, AT(stiffness), OPTIONAL,
     .help = "of the mesh along its line of action in the transverse plane; default: "
             "c_gamma of ISO 6336-1 method B times the common face width"},
    {NUMBER("damping_ratio", 0, 2), AT(damping_ratio), DEFAULT("0.07"),
     .help = "in contact, of the two gears' bodies on the mesh stiffness"},
    {NUMBER("backlash_mm", 0, 10), AT(backlash), OPTIONAL,
     .help = "normal backlash j_bn; default: 2/3 (0.06 + 0.0005 a + 0.03 m_n) mm of "
             "ISO/TR 10064-2"},
    {NUMBER("entry_um", 0, 100), ABOVE, AT(entry), DEFAULT("4"), ONLY("contact", "film"),
     .help = "deflection over which the stiffness rises from nothing to its full value"},
    {NUMBER("film_damping", 0, 1), AT(film), DEFAULT("0.05"), ONLY("contact", "film"),
     .help = "damping in the gap as a share of that in contact"},
    END};
const gm_section gm_schema_flanks = {
    .title = "flanks", .word = "flanks", .help = "Between the teeth of two gears.",
    .fields = flank_fields};

static const gm_field dog_fields[] = {
    {.key = "contact", .type = GM_FIELD_CHOICE, .choices = contact_models, AT(model),
     DEFAULT("film"), .help = "as of meshes"},
    {NUMBER("stiffness_Nm_rad", 0, 1e10), ABOVE, AT(stiffness), DEFAULT("2e5"),
     .help = "between hub and gear"},
    {NUMBER("damping_ratio", 0, 2), AT(damping_ratio), DEFAULT("0.1"),
     .help = "in contact, of shaft and gear on that stiffness"},
    {NUMBER("backlash_deg", 0, 30), AT(backlash), DEFAULT("0.3"),
     .help = "play from flank to flank"},
    {NUMBER("entry_deg", 0, 1), ABOVE, AT(entry), DEFAULT("0.02"),
     ONLY("contact", "film"),
     .help = "angle over which the stiffness rises from nothing to its full value"},
    {NUMBER("film_damping", 0, 1), AT(film), DEFAULT("0.05"), ONLY("contact", "film"),
     .help = "damping in the gap as a share of that in contact"},
    END};
const gm_section gm_schema_dogs = {
    .title = "dogs", .word = "dogs", .help = "Teeth of a locked synchroniser.",
    .fields = dog_fields};
#undef OWNER
/* clang-format on */
