/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Values that nothing would read are mistakes, as is nothing where a value is expected:
 * each is refused with its sentence.
 */
#include "description_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define CHANGED GM_BINARY_DIR "/test_description_effect.yaml"
#define FIRST "first: {gears: [g1_drive, g1_driven]"
#define REAR "type: deep_groove_ball, designation: \"6306\"}"
#define NEEDLE "bearing: {type: needle_roller, bore_mm: 36, outer_mm: 42, width_mm: 18}}"
#define SEVENTH "7: {lock: g7_driven, ratio: 2.5653}"

static const gm_test_rule rules[] = {
    /* settings of another model */
    {FIRST, FIRST ", loss: {model: temperature_dependent, efficiency: 0.99}",
     "efficiency",
     "mesh 'first', loss: efficiency has an effect only with model constant, found model "
     "temperature_dependent",
     GM_ERR_FORMAT, NULL},
    {FIRST, FIRST ", loss: {efficiency: 0.99}", "efficiency",
     "mesh 'first', loss: efficiency has an effect only with model constant, found model "
     "temperature_dependent",
     GM_ERR_FORMAT, NULL},
    {FIRST,
     FIRST ", loss: {model: constant, efficiency: 0.99, minimum_line_load_N_mm: 100}",
     "minimum_line_load",
     "mesh 'first', loss: minimum_line_load_N_mm has an effect only with model "
     "temperature_dependent, found model constant",
     GM_ERR_FORMAT, NULL},
    {FIRST, FIRST ", loss: {model: constant, efficiency: 0.99, method: iso14179_1}",
     "method",
     "mesh 'first', loss: method has an effect only with model temperature_dependent, "
     "found model constant",
     GM_ERR_FORMAT, NULL},
    {FIRST, FIRST ", loss: {model: torque_dependent, idle_torque_Nm: 1}", "first: {",
     "mesh 'first': the loss model torque_dependent needs idle_torque_Nm and "
     "torque_share",
     GM_ERR_MODEL, NULL},
    {REAR, "type: deep_groove_ball, designation: \"6306\", f0: 2}", "f0: 2",
     "bearing 'input_odd_rear': f0 has an effect only with friction palmgren, found "
     "friction skf",
     GM_ERR_FORMAT, NULL},
    {REAR, "type: deep_groove_ball, designation: \"6306\", friction: none, f1: 0.1}",
     "f1: 0.1",
     "bearing 'input_odd_rear': f1 has an effect only with friction palmgren, found "
     "friction none",
     GM_ERR_FORMAT, NULL},
    {NEEDLE,
     "bearing: {type: needle_roller, bore_mm: 36, outer_mm: 42, axial_factor: 1.6}}",
     "axial_factor",
     "gear 'g1_driven', bearing: axial_factor has an effect only with type "
     "tapered_roller, found type needle_roller",
     GM_ERR_FORMAT, NULL},
    {REAR,
     "type: deep_groove_ball, designation: \"6306\", friction: coulomb, mu: 0.001, "
     "static_mu: 0.002}",
     "static_mu",
     "bearing 'input_odd_rear': static_mu has an effect only with friction elastic or "
     "hydrodynamic, found friction coulomb",
     GM_ERR_FORMAT, NULL},
    {REAR,
     "type: deep_groove_ball, designation: \"6306\", friction: palmgren, "
     "torque_over_speed: [{speed_rpm: 0, torque_Nm: 1}]}",
     "torque_over_speed",
     "bearing 'input_odd_rear': torque_over_speed has an effect only with friction "
     "coulomb, found friction palmgren",
     GM_ERR_FORMAT, NULL},
    {REAR,
     "type: deep_groove_ball, designation: \"6306\", friction: coulomb, "
     "torque_over_speed: [{speed_rpm: 0, torque_Nm: 1}, {speed_rpm: 9, torque_Nm: 0.5}]}",
     "input_odd_rear",
     "bearing 'input_odd_rear': torque_over_speed must not fall at its end, which is "
     "continued; found 0.5 N.m after 1",
     GM_ERR_MODEL, NULL},
    {REAR,
     "type: deep_groove_ball, designation: \"6306\", friction: coulomb, "
     "torque_over_speed: [{speed_rpm: 0}]}",
     "torque_over_speed",
     "bearing 'input_odd_rear', point 1: torque_Nm is missing; expected a number in N.m "
     "from 0 to 100000",
     GM_ERR_FORMAT, NULL},
    {REAR, "type: deep_groove_ball, designation: \"6306\", seal_diameter_mm: 40}",
     "seal_diameter",
     "bearing 'input_odd_rear': seal_diameter_mm has an effect only with seals rsl, rsh "
     "or rs1, found seals none",
     GM_ERR_FORMAT, NULL},
    {REAR, "type: deep_groove_ball, designation: \"6306\", seals: rs1}", "input_odd_rear",
     "bearing 'input_odd_rear': seals need their seal_diameter_mm", GM_ERR_MODEL, NULL},
    {REAR,
     "type: deep_groove_ball, designation: \"6306\", seals: rsh, seal_diameter_mm: 40}",
     "input_odd_rear",
     "bearing 'input_odd_rear': seals rsl and rsh are known up to an outer_mm of 52; "
     "found 72",
     GM_ERR_MODEL, NULL},
    {REAR, "type: plain, bore_mm: 30, outer_mm: 72}", "input_odd_rear",
     "bearing 'input_odd_rear': a plain bearing has friction none, coulomb, elastic or "
     "hydrodynamic; found skf",
     GM_ERR_MODEL, NULL},
    /* series that nothing looks up */
    {REAR, "type: deep_groove_ball, designation: \"6306\", series: \"63\"}",
     "input_odd_rear",
     "bearing 'input_odd_rear': the series follows from the designation; found series "
     "'63' beside designation '6306'",
     GM_ERR_MODEL, NULL},
    {NEEDLE, "bearing: {type: needle_roller, bore_mm: 36, outer_mm: 42, series: \"22\"}}",
     "g1_driven: {",
     "gear 'g1_driven': the series of a needle roller bearing has no effect, found '22'",
     GM_ERR_MODEL, NULL},
    /* what a bearing needs, by its key */
    {REAR, "type: deep_groove_ball, series: \"63\", bore_mm: 30, outer_mm: 72}",
     "input_odd_rear",
     "bearing 'input_odd_rear': a deep groove ball bearing with friction skf needs "
     "static_load_N, its static load rating C0",
     GM_ERR_MODEL, NULL},
    {REAR, "type: cylindrical_roller, bore_mm: 30, outer_mm: 72}", "input_odd_rear",
     "bearing 'input_odd_rear': a cylindrical roller bearing with friction skf needs its "
     "series: one of 2, 3, 4, 10, 12, 20, 22, 23, 22_high_cap, 23_high_cap, "
     "all_full_comp",
     GM_ERR_MODEL, NULL},
    {REAR, "type: tapered_roller, series: \"302\", bore_mm: 30, outer_mm: 72}",
     "input_odd_rear",
     "bearing 'input_odd_rear': a tapered roller bearing with friction skf needs "
     "axial_factor, its Y",
     GM_ERR_MODEL, NULL},
    {REAR, "type: deep_groove_ball, series: \"63\"}", "input_odd_rear",
     "bearing 'input_odd_rear': a deep groove ball bearing with friction skf needs "
     "bore_mm and outer_mm, or its designation",
     GM_ERR_MODEL, NULL},
    /* parts */
    {"width_mm: 20, position_mm: 250}", "width_mm: 20, position_mm: 250, " NEEDLE,
     "g1_drive: {",
     "gear 'g1_drive': a gear that does not idle turns with its shaft: its bearing has "
     "no effect",
     GM_ERR_MODEL, NULL},
    {SEVENTH, SEVENTH "\n      9: {lock: g5_driven}", "9: {lock",
     "path 'odd': gear 9: locks 'g5_driven', already locked by gear 5 in line ",
     GM_ERR_MODEL, "5: {lock"},
    /* nothing in place of a text */
    {"name: dct7", "name: null", "name: null",
     "name must be one line of 1 to 47 bytes, found 'null'", GM_ERR_FORMAT, NULL},
    {"name: dct7", "name: ~", "name: ~",
     "name must be one line of 1 to 47 bytes, found '~'", GM_ERR_FORMAT, NULL},
    {"name: dct7", "name:", "name:",
     "name must be one line of 1 to 47 bytes, found nothing", GM_ERR_FORMAT, NULL},
    {"name: dct7", "name: \"  \"", "name: \"",
     "name must be one line of 1 to 47 bytes, found \"  \"", GM_ERR_FORMAT, NULL},
    {"  name: 75W transmission oil", "  name:", "  name:",
     "oil: name must be one line of 1 to 47 bytes, found nothing", GM_ERR_FORMAT, NULL},
    {"title: Dry 7-speed dual-clutch gearset after the VW DQ200", "title: null",
     "title: null", "title must be text, found 'null'", GM_ERR_FORMAT, NULL},
    /* slower than the slowest point of a sweep */
    {"input_speed_max_rpm: 6500", "input_speed_max_rpm: 9.9", "input_speed_max_rpm",
     "limits: input_speed_max_rpm must be a number in rpm from 10 to 100000, found '9.9'",
     GM_ERR_FORMAT, NULL},
};

static void what_has_no_effect_is_refused(void **state)
{
    (void)state;
    char *example = gm_test_slurp(EXAMPLE);
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        gm_test_rule_answers(example, CHANGED, &rules[i]);
    free(example);
}

typedef struct change {
    const char *find, *replace;
} change;

/* The same keys where they do something. */
static const change good[] = {
    {FIRST, FIRST ", loss: {model: constant, efficiency: 0.99}"},
    {FIRST, FIRST ", loss: {minimum_line_load_N_mm: 100}"},
    {REAR, "type: deep_groove_ball, designation: \"6306\", friction: palmgren, f0: 2, "
           "f1: 0.001}"},
    {REAR, "type: cylindrical_roller, series: all_full_comp, bore_mm: 30, outer_mm: 72, "
           "friction: palmgren}"},
    {REAR, "type: tapered_roller, series: \"303\", bore_mm: 30, outer_mm: 72, "
           "axial_factor: 1.9}"},
    /* data of the bearing, whatever the model */
    {REAR, "type: deep_groove_ball, series: \"63\", bore_mm: 30, outer_mm: 72, "
           "static_load_N: 16000, friction: palmgren}"},
    {"title: Dry 7-speed dual-clutch gearset after the VW DQ200", "title: \"\""},
    {"title: Dry 7-speed dual-clutch gearset after the VW DQ200\n", ""},
    {"name: dct7", "name: \"null\""},
    {"input_speed_max_rpm: 6500", "input_speed_max_rpm: 10"},
};

static void what_has_an_effect_is_taken(void **state)
{
    (void)state;
    char *example = gm_test_slurp(EXAMPLE);
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        char *text = gm_test_replaced(example, good[i].find, good[i].replace);
        gm_test_spill(CHANGED, text);
        gm_description_destroy(gm_test_read(CHANGED));
        free(text);
    }
    free(example);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_has_no_effect_is_refused),
        cmocka_unit_test(what_has_an_effect_is_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
