/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the vehicle file, and its reading by the reader of descriptions. What is
 * a property of the car must be given; fields of driver and control have defaults. The
 * number of a default is that of gm_vehicle_reference.
 */
#include "vehicle/gm_vehicle.h"

#include "model/description_fields.h"
#include "model/description_yaml.h"
#include "model/gm_description.h"
#include "model/schema_fields.h"

typedef struct vehicle_file {
    int format;
    char name[GM_NAME_SIZE];
    gm_vehicle car;
} vehicle_file;

/* clang-format off */

#define OWNER gm_vehicle
static const gm_field body_fields[] = {
    {NUMBER("mass_kg", 0, 100000), ABOVE, AT(mass), .help = "of the whole vehicle"},
    {NUMBER("drag_area_m2", 0, 20), AT(drag_area), .help = "c_d times frontal area"},
    {NUMBER("rolling_coefficient", 0, 0.2), AT(rolling_coefficient),
     .help = "rolling resistance by weight"},
    END};
static const gm_section body = {
    .title = "body", .word = "body", .help = "What moves and what resists.",
    .fields = body_fields};

static const gm_field wheel_fields[] = {
    {NUMBER("radius_mm", 50, 2000), AT(wheel_radius), .help = "dynamic radius"},
    {NUMBER("inertia_kgm2", 0, 1000), AT(wheel_inertia),
     .help = "of all wheels together"},
    END};
static const gm_section wheels = {
    .title = "wheels", .word = "wheels", .help = "All wheels.", .fields = wheel_fields};

static const gm_field tyre_fields[] = {
    {NUMBER("slip_stiffness_N", 1000, 1e8), AT(tyre_stiffness),
     .help = "force for a slip of 1, extrapolated from small slips, of all driven tyres"},
    {NUMBER("force_max_N", 100, 1e7), AT(tyre_force_max),
     .help = "largest force of all driven tyres"},
    END};
static const gm_section tyres = {
    .title = "tyres", .word = "tyres",
    .help = "Tyres that slip; without this group the wheels roll.",
    .fields = tyre_fields};

static const gm_field road_fields[] = {
    {NUMBER("air_density_kg_m3", 0, 3), AT(air_density), DEFAULT("1.2"),
     .help = "of the air"},
    {NUMBER("gravity_m_s2", 1, 30), AT(gravity), DEFAULT("9.81"), .help = "gravity"},
    {NUMBER("grade_percent", -50, 50), AT(grade), DEFAULT("0"),
     .help = "rise over run of the whole road; the cycle's own is added"},
    END};
static const gm_section road = {
    .title = "road", .word = "road", .help = "Where it drives.", .fields = road_fields};

static const gm_field shaft_fields[] = {
    {NUMBER("stiffness_Nm_rad", 10, 1e7), AT(shaft_stiffness),
     .help = "of both driveshafts together, at the output flange"},
    {NUMBER("damping_Nms_rad", 0, 1e5), AT(shaft_damping), .help = "likewise"},
    END};
static const gm_section driveshafts = {
    .title = "driveshafts", .word = "driveshafts",
    .help = "Between the gearset's output and the wheels.", .fields = shaft_fields};

static const gm_field mount_fields[] = {
    {NUMBER("inertia_kgm2", 0, 1000), ABOVE, AT(mount_inertia),
     .help = "of engine and gearbox about the roll axis"},
    {NUMBER("stiffness_Nm_rad", 100, 1e8), AT(mount_stiffness), .help = "against roll"},
    {NUMBER("damping_Nms_rad", 0, 1e6), AT(mount_damping), .help = "likewise"},
    END};
static const gm_section engine_mounts = {
    .title = "mounts", .word = "mounts",
    .help = "Mounts on which engine and gearbox roll; without this group they are rigid.",
    .fields = mount_fields};

static const gm_field flywheel_fields[] = {
    {NUMBER("stiffness_Nm_rad", 1, 1e6), AT(flywheel_stiffness),
     .help = "of its springs"},
    {NUMBER("damping_Nms_rad", 0, 1e4), AT(flywheel_damping), .help = "of its springs"},
    {NUMBER("secondary_inertia_kgm2", 0, 10), ABOVE, AT(drum_inertia),
     .help = "secondary side with the clutch drum"},
    END};
static const gm_section flywheel = {
    .title = "flywheel", .word = "flywheel", .help = "The dual-mass flywheel.",
    .fields = flywheel_fields};

static const gm_field clutch_fields[] = {
    {NUMBER("torque_max_Nm", 1, 1e5), AT(clutch_torque_max), .help = "largest capacity"},
    {NUMBER("launch_speed_rad_s", 10, 1000), AT(launch_speed), DEFAULT("82"),
     .help = "engine speed from which on the clutch closes"},
    {NUMBER("launch_gain_Nms2_rad2", 0, 100), ABOVE, AT(launch_gain), DEFAULT("0.04"),
     .help = "capacity over the square of the speed beyond it"},
    {NUMBER("shift_margin_Nm", 1, 1e4), AT(clutch_margin), DEFAULT("30"),
     .help = "what it holds beyond the engine's torque while it slips much"},
    {NUMBER("slip_rad_s", 0.01, 50), AT(clutch_slip), DEFAULT("0.5"),
     .help = "torque is capacity times tanh(slip / this)"},
    END};
static const gm_section clutch = {
    .title = "clutch", .word = "clutch",
    .help = "Each of the dry clutches, one for a path.", .fields = clutch_fields};

static const gm_field driver_fields[] = {
    {NUMBER("gain_Ns_m", 0, 1e6), ABOVE, AT(driver_gain), DEFAULT("1500"),
     .help = "force by error of speed"},
    {NUMBER("integral_gain_N_m", 0, 1e6), AT(driver_integral), DEFAULT("300"),
     .help = "force by its integral"},
    {NUMBER("integral_max_N", 0, 1e6), ABOVE, AT(driver_windup), DEFAULT("2500"),
     .help = "largest integral part"},
    {NUMBER("mass_factor", 0, 3), AT(driver_mass_factor), DEFAULT("1.06"),
     .help = "feed-forward force is this times mass times acceleration, and road load"},
    END};
static const gm_section driver = {
    .title = "driver", .word = "driver", .help = "Who follows the cycle.",
    .fields = driver_fields};

static const gm_field control_fields[] = {
    {NUMBER("shift_time_s", 0.01, 10), AT(shift_time), DEFAULT("0.4"),
     .help = "from clutch to clutch"},
    {NUMBER("preselect_time_s", 0.01, 60), AT(preselect_time), DEFAULT("1.5"),
     .help = "the next gear is engaged so long before the shift"},
    {NUMBER("interrupt_time_s", 0.01, 10), AT(interrupt_time), DEFAULT("0.3"),
     .help = "within one path: to open the clutch, for the synchroniser, to close it"},
    END};
static const gm_section control = {
    .title = "control", .word = "control", .help = "The transmission's control.",
    .fields = control_fields};
#undef OWNER

#define OWNER gm_full_load_point
static const gm_field point_fields[] = {
    {NUMBER("speed_rpm", 0, 100000), AT(speed), .help = "engine speed"},
    {NUMBER("torque_Nm", 0, 100000), ABOVE, AT(torque), .help = "at full load"},
    END};
static const gm_section full_load = {
    .title = "full load", .word = "point", .help = "By increasing speed.",
    .fields = point_fields, .size = sizeof(gm_full_load_point), .key = GM_KEY_NONE,
    .line = offsetof(gm_full_load_point, line)};
#undef OWNER

#define OWNER gm_vehicle
static const gm_field engine_fields[] = {
    {NUMBER("inertia_kgm2", 0, 100), ABOVE, AT(engine_inertia),
     .help = "with the primary side of the flywheel"},
    {.key = "full_load", .type = GM_FIELD_ITEMS, .section = &full_load,
     AT(full_load.point), .count_offset = offsetof(gm_vehicle, full_load.n),
     .fixed_count = GM_VEHICLE_MAX_POINTS,
     .help = "linear between points, constant beyond"},
    {NUMBER("drag_torque_Nm", 0, 10000), AT(drag_torque), .help = "without fuel"},
    {NUMBER("drag_per_speed_Nms_rad", 0, 100), AT(drag_per_speed),
     .help = "what is added to it by speed"},
    {NUMBER("torque_lag_s", 0.001, 10), AT(torque_lag), .help = "first order"},
    {NUMBER("idle_speed_rad_s", 10, 1000), AT(idle_speed),
     .help = "kept by the governor"},
    {NUMBER("idle_gain_Nms_rad", 0, 1000), ABOVE, AT(idle_gain), DEFAULT("2.5"),
     .help = "of the governor"},
    END};
static const gm_section engine = {
    .title = "engine", .word = "engine", .help = "The combustion engine.",
    .fields = engine_fields};
#undef OWNER

#define OWNER vehicle_file
#define GROUP(name, part, words)                                                         \
    {.key = name, .type = GM_FIELD_GROUP, .section = &part, AT(car), .help = words}
#define GROUP_IF(name, part, need_, words)                                               \
    {.key = name, .type = GM_FIELD_GROUP, .section = &part, AT(car), .need = need_,      \
     .help = words}
static const gm_field root_fields[] = {
    {INTEGER("format", 1, 1), AT(format), .help = "version of this format"},
    {.key = "name", .type = GM_FIELD_WORDS, AT(name), .help = "for people"},
    GROUP("body", body, "mass and resistance"),
    GROUP("wheels", wheels, "radius and inertia"),
    GROUP_IF("tyres", tyres, GM_NEED_NOTHING, "slip"),
    GROUP_IF("road", road, GM_NEED_DEFAULT, "air, gravity, grade"),
    GROUP("driveshafts", driveshafts, "stiffness and damping"),
    GROUP_IF("mounts", engine_mounts, GM_NEED_NOTHING, "roll of engine and gearbox"),
    GROUP("engine", engine, "torque and inertia"),
    GROUP("flywheel", flywheel, "dual-mass flywheel"),
    GROUP("clutch", clutch, "capacity and launch"),
    GROUP_IF("driver", driver, GM_NEED_DEFAULT, "controller of speed"),
    GROUP_IF("control", control, GM_NEED_DEFAULT, "shifts"),
    END};
static const gm_section root = {
    .title = "vehicle", .word = "vehicle",
    .help = "What a gearset is driven in, from the engine to the road.",
    .fields = root_fields, .size = sizeof(vehicle_file)};
#undef OWNER
/* clang-format on */

void gm_vehicle_help(void (*write)(void *context, const char *text), void *context)
{
    gm_schema_help(&root, write, context);
}

/* A rule between several fields, which no table can say. */
static gm_status check(const char *path, const gm_vehicle *vehicle, gm_error *error)
{
    gm_error why = {GM_OK, ""};
    const gm_full_load *curve = &vehicle->full_load;
    for (int i = 1; i < curve->n; i++)
        if (!(curve->point[i].speed > curve->point[i - 1].speed))
            return gm_fail(error, GM_ERR_FORMAT,
                           "%s:%d: engine: full_load: speeds must increase", path,
                           curve->point[i].line);
    if (gm_vehicle_check(vehicle, &why) != GM_OK)
        return gm_fail(error, GM_ERR_FORMAT, "%s: %s", path, why.message);
    return GM_OK;
}

gm_status gm_vehicle_read(const char *path, gm_vehicle *vehicle, gm_error *error)
{
    char sha256[GM_SHA256_TEXT];
    gm_yaml *tree = NULL;
    vehicle_file file = {.format = 0};
    gm_status status = gm_yaml_read(path, sha256, &tree, error);
    if (status == GM_OK)
        status = gm_fields_read(path, &root, tree, &file, error);
    gm_yaml_destroy(tree);
    if (status == GM_OK)
        status = check(path, &file.car, error);
    if (status == GM_OK)
        *vehicle = file.car;
    return status;
}
