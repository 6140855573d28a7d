/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The gearset as its file describes it: named parts with dimensions, in SI units. Plain
 * data; read by gm_description_read, which refuses what breaks a rule. The fields of the
 * file, their units and ranges are listed in tables, schema_*.c.
 *
 * Coordinates: x along the shafts, y and z across, z up (gravity is -z). All shafts are
 * parallel to x. Positive rotation is about +x.
 */
#ifndef GM_DESCRIPTION_H
#define GM_DESCRIPTION_H

#include "base/gm_status.h"
#include "model/gm_steady.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_NAME_SIZE 48
#define GM_HOUSING (-1)        /* in place of a shaft index: the housing */
#define GM_STEEL_DENSITY 7850. /* kg/m3 */

/** A part's name and the line of the file where it stands. */
typedef struct gm_label {
    char name[GM_NAME_SIZE];
    int line;
} gm_label;

/** A cylinder of a shaft. */
typedef struct gm_segment {
    double from, to; /* axial, m */
    double diameter; /* m */
    double bore;     /* inner diameter, 0 if solid, m */
    int line;
} gm_segment;

typedef enum gm_torsion_model { GM_TORSION_RIGID, GM_TORSION_ELASTIC } gm_torsion_model;

typedef struct gm_shaft {
    gm_label id;
    gm_torsion_model torsion;
    double torsion_damping; /* ratio, of each piece */
    double flange;          /* x of its flange, m; NAN: the end with the lower x */
    double y, z;            /* m */
    double inertia, mass;   /* of the shaft without its gears; NAN: from the segments */
    gm_segment *segments;
    int n_segments;
} gm_shaft;

typedef enum gm_bearing_type {
    GM_BEARING_DEEP_GROOVE_BALL,
    GM_BEARING_ANGULAR_CONTACT_BALL,
    GM_BEARING_CYLINDRICAL_ROLLER,
    GM_BEARING_NEEDLE_ROLLER,
    GM_BEARING_TAPERED_ROLLER,
    GM_BEARING_PLAIN
} gm_bearing_type;

typedef enum gm_bearing_friction {
    GM_FRICTION_NONE, /* support only: its friction belongs to something outside */
    GM_FRICTION_COULOMB,
    GM_FRICTION_ELASTIC,      /* presliding, with a state in motion */
    GM_FRICTION_HYDRODYNAMIC, /* Stribeck and viscous */
    GM_FRICTION_SKF,
    GM_FRICTION_PALMGREN
} gm_bearing_friction_model;

/** How much oil reaches the contacts of a rolling bearing (SKF). */
typedef enum gm_bearing_supply {
    GM_SUPPLY_BATH,   /* low oil bath or jet */
    GM_SUPPLY_GREASE, /* grease, oil-air */
    GM_SUPPLY_FLOODED /* no starvation */
} gm_bearing_supply;

/** Contact seals on both sides of a capped bearing (SKF). */
typedef enum gm_bearing_cap {
    GM_CAP_NONE,
    GM_CAP_RSL,
    GM_CAP_RSH,
    GM_CAP_RS1
} gm_bearing_cap;

/** A point of a table of friction over speed. */
typedef struct gm_friction_point {
    double speed, torque; /* rad/s, N.m */
    int line;
} gm_friction_point;

enum { GM_FRICTION_POINTS = 16 };

/** A bearing's own data, as the friction models need it. */
typedef struct gm_bearing_data {
    gm_bearing_type type;
    gm_bearing_friction_model friction;
    char designation[GM_NAME_SIZE]; /* such as "6206"; empty when dimensions are given */
    char series[GM_NAME_SIZE];      /* row of the SKF constants, such as "62" or "2" */
    double d, D, B;                 /* bore, outside diameter, width [m] */
    double C0;                      /* static load rating [N] */
    double Y;                       /* tapered: axial factor */
    double f0, f1;                  /* Palmgren; NAN: default of the type */
    gm_bearing_supply supply;       /* SKF */
    gm_bearing_cap cap;             /* SKF */
    double cap_diameter;            /* where its seals slide, m */
    gm_friction_point table[GM_FRICTION_POINTS]; /* Coulomb: in place of a torque */
    int n_table;
    double torque, static_torque; /* Coulomb, elastic, hydrodynamic, N.m */
    double mu, static_mu;         /* likewise, at the mean radius */
    double stribeck;              /* elastic, hydrodynamic: w_s, rad/s */
    double viscous;               /* likewise, N.m.s/rad */
    double stiffness, damping;    /* elastic: N.m/rad, N.m.s/rad */
    double clearance;             /* hydrodynamic, plain: radial, m */
    /* NAN where not given and not known from the designation */
} gm_bearing_data;

/** How a gear that dips into the oil churns it. */
typedef enum gm_churning_model {
    GM_CHURNING_NONE,
    GM_CHURNING_CHANGENET_VELEX,
    GM_CHURNING_ISO14179_1,
    GM_CHURNING_ISO14179_2 /* counted with its meshes */
} gm_churning_model;

/** A gear wheel; an idling one turns on its shaft on a bearing of its own. */
typedef struct gm_wheel {
    gm_label id;
    int shaft;
    int teeth;
    double normal_module;  /* m */
    double helix;          /* rad, > 0 right-handed */
    double pressure_angle; /* normal, rad */
    double profile_shift;  /* x */
    double width;          /* m */
    double position;       /* axial, middle of the face, m */
    double roughness;      /* Ra, m */
    int internal;          /* 1: internal teeth (ring) */
    int idles;             /* 1: turns on its shaft until a synchroniser locks it */
    int planets;           /* so many, evenly on pins of the shaft, their carrier; 0: not
                                a planet */
    double pin_radius;     /* of a planet: axis of the carrier to its own, m */
    double pin_angle;      /* of the first planet, from y to z, rad */
    double inertia, mass;  /* NAN: disc from bore to pitch diameter */
    double bore;           /* of that disc; if not given: the shaft's diameter at the
                                position, of an idling gear its bearing's D [m] */
    gm_bearing_data bearing;    /* of an idling gear */
    gm_churning_model churning; /* when it dips into the oil */
    int windage;                /* 1: computed */
} gm_wheel;

typedef enum gm_mesh_loss_model {
    GM_MESH_CONSTANT,             /* efficiency */
    GM_MESH_TORQUE_DEPENDENT,     /* idle_torque + torque_share |T| */
    GM_MESH_TEMPERATURE_DEPENDENT /* by a standard, with the oil's viscosity */
} gm_mesh_loss_model;

typedef enum gm_mesh_method { GM_MESH_ISO14179_2, GM_MESH_ISO14179_1 } gm_mesh_method;

typedef enum gm_contact_model {
    GM_CONTACT_FILM,  /* an oil film: entered softly, damped also in the gap */
    GM_CONTACT_DRY,   /* dry flanks: no force in the gap, no pull */
    GM_CONTACT_LINEAR /* no gap (not in the file: shafts, clutches) */
} gm_contact_model;

/** What happens between flanks: of a mesh, or of a synchroniser's dogs. */
typedef struct gm_flanks {
    gm_contact_model model;
    double stiffness;     /* mesh: along the line of action, N/m; dogs: N.m/rad; NAN: mesh
                             by ISO 6336-1 */
    double damping_ratio; /* of the parts it couples */
    double backlash;      /* mesh: normal, m; dogs: rad; NAN: mesh by ISO/TR 10064-2 */
    double entry;         /* depth of soft entry, m; dogs: rad */
    double film;          /* damping in the gap as a share of that in contact */
} gm_flanks;

typedef struct gm_mesh {
    gm_label id;
    int wheel[2];
    gm_mesh_loss_model loss;
    gm_mesh_method method;    /* temperature dependent */
    double efficiency;        /* constant; NAN: not given */
    double idle_torque;       /* torque dependent: at wheel[0], N.m; NAN: not given */
    double torque_share;      /* torque dependent: of the torque that enters; NAN */
    double minimum_line_load; /* lower limit of F_bt/b in the friction coefficient, N/m */
    gm_flanks flanks;
} gm_mesh;

typedef struct gm_bearing {
    gm_label id;
    int shaft;
    int on; /* GM_HOUSING or the shaft that carries the outer ring */
    double position;
    int locating;          /* takes axial load */
    int thrust;            /* 0: from both sides; +1: of a shaft pushed towards +x; -1 */
    double preload;        /* of the pair at 20 degC, at its +1 bearing, N */
    double preload_change; /* by temperature, N/K */
    double induced;        /* axial force by radial load; NAN: default of the type */
    gm_bearing_data data;
    double radial_stiffness,
        axial_stiffness; /* N/m; matter only where statics cannot tell */
} gm_bearing;

typedef enum gm_seal_model {
    GM_SEAL_ISO14179_2,
    GM_SEAL_ISO14179_1_FPM,
    GM_SEAL_ISO14179_1_NBR,
    GM_SEAL_LINKE
} gm_seal_model;

typedef struct gm_seal {
    gm_label id;
    int shaft;
    int on; /* GM_HOUSING or a shaft */
    double diameter;
    gm_seal_model model;
} gm_seal;

/** The oil-filled gap between two concentric shafts. */
typedef struct gm_gap {
    gm_label id;
    int inner, outer;
    double radius, length, clearance; /* m */
} gm_gap;

/** An oil jet on a gear. */
typedef struct gm_jet {
    gm_label id;
    int wheel;
    double flow, speed; /* m3/s, m/s */
    double factor;      /* of the impulse loss */
} gm_jet;

/** A synchroniser: sits on a shaft, locks one of its gears at a time. */
typedef struct gm_synchroniser {
    gm_label id;
    int shaft;
    int n_wheels;
    int *wheels;        /* [n_wheels] idling gears on that shaft */
    double cone_torque; /* capacity at the cone, N.m */
    double cone_radius, cone_width, cone_clearance; /* open cone drag, m */
    gm_flanks dogs;
} gm_synchroniser;

/** A clutch between two concentric shafts, or a brake: a lock inside the gearset. */
typedef struct gm_clutch {
    gm_label id;
    int shaft;
    int on; /* the other shaft; GM_HOUSING: a brake */
    double torque_capacity;
    int surfaces;                      /* friction surfaces; 0: no open drag */
    double inner_radius, outer_radius; /* m */
    double clearance;                  /* of one open gap, m */
    gm_flanks closed;                  /* what gives way when it is closed */
    double feed; /* oil fed to its gaps, m3/s; NAN: they stay full */
} gm_clutch;

/** What a gear of a path locks. */
typedef struct gm_lock {
    int is_clutch; /* 1: index of a clutch; 0: of an idling gear, locked to its shaft */
    int index;
} gm_lock;

typedef struct gm_path_gear {
    int number;
    int n_locks;
    gm_lock *locks; /* [n_locks] */
    double ratio;   /* given overall ratio input/output, signed; NAN: not given */
    int line;
} gm_path_gear;

/** A path that has one gear, which locks what neutral locks (as a rule nothing), has no
 *  neutral: gear 0 is no gear of it and its rest gear, which it is in while another path
 *  is looked at alone, is that gear. */
typedef struct gm_path_part {
    gm_label id; /* "odd", "even" or "input" */
    int shaft;
    int n_gears;
    gm_path_gear *gears;  /* ascending by number, without 0 */
    gm_path_gear neutral; /* number 0: what is locked in neutral */
    int has_neutral;
} gm_path_part;

/** Whether two locks are the same part, and two gears lock the same parts. */
int gm_same_lock(const gm_lock *a, const gm_lock *b);
int gm_same_locks(const gm_path_gear *a, const gm_path_gear *b);

/** Number of a path's rest gear: 0, or its only gear. */
int gm_path_rest_gear(const gm_path_part *path);

/** What a path locks in a gear, 0 for neutral; NULL: it has no such gear. */
const gm_path_gear *gm_path_gear_of(const gm_path_part *path, int number);

typedef struct gm_oil_part {
    char name[GM_NAME_SIZE];
    double viscosity_40, viscosity_100; /* kinematic, m2/s */
    double third_viscosity;       /* likewise at third_temperature; NAN or 0: Walther */
    double third_temperature;     /* K */
    double density_15;            /* kg/m3 */
    double thermal_expansion;     /* alpha of rho = rho15 (1 - alpha (T - 15)), 1/K */
    double temperature;           /* K */
    double mesh_lubricant_factor; /* X_L of ISO/TR 14179-2 */
    double bearing_mu_ehl;        /* SKF sliding friction coefficient, full film */
    double level;                 /* z of the surface at rest, m; NAN: no bath */
    double volume;                /* m3 */
} gm_oil_part;

typedef struct gm_description {
    char *file;      /* as given */
    char sha256[65]; /* of the file's bytes */
    int format;      /* version of the file format */
    char name[GM_NAME_SIZE];
    char *title;
    double speed_max;  /* input, rad/s */
    double torque_max; /* input, N.m */
    gm_oil_part oil;
    int n_shafts, n_wheels, n_meshes, n_bearings, n_seals, n_gaps, n_jets,
        n_synchronisers, n_clutches, n_paths;
    gm_shaft *shafts;
    gm_wheel *wheels;
    gm_mesh *meshes;
    gm_bearing *bearings;
    gm_seal *seals;
    gm_gap *gaps;
    gm_jet *jets;
    gm_synchroniser *synchronisers;
    gm_clutch *clutches;
    gm_path_part paths[GM_MAX_INPUT_PATHS]; /* "odd" before "even" */
    int output;                             /* shaft */
} gm_description;

/** Read and check a description file.
 *  On success *description is new and the caller's (gm_description_destroy).
 *  Otherwise one sentence: file, line, element, rule and the numbers that disagree.
 *  GM_ERR_IO, GM_ERR_FORMAT (not YAML, unknown key, not a number, out of range),
 *  GM_ERR_MODEL (parts that do not fit together), GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_description_read(const char *path, gm_description **description,
                                           gm_error *error);
void gm_description_destroy(gm_description *description);

/** The synchroniser that locks an idling gear; NULL: none does. */
const gm_synchroniser *gm_synchroniser_of(const gm_description *description, int wheel);

/** Name of what is locked, and the torque up to which it synchronises [N.m]; infinite
 *  without a synchroniser. */
const char *gm_lock_name(const gm_description *description, const gm_lock *lock);
double gm_lock_capacity(const gm_description *description, const gm_lock *lock);

/** Reference of the file format, derived from the schema: calls write with successive
 *  pieces of Markdown text. */
void gm_description_help(void (*write)(void *context, const char *text), void *context);

#ifdef __cplusplus
}
#endif
#endif
