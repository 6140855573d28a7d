/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Every rule of the description file, broken in a copy of the example, with the exact
 * sentence it answers with: file, line, element, rule, the values that disagree.
 */
#include "description_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CHANGED GM_BINARY_DIR "/test_description_rules.yaml"

static const gm_test_rule rules[] = {
    /* numbers */
    {"width_mm: 20, position_mm: 250}", "width_mm: 20 mm, position_mm: 250}",
     "width_mm: 20 mm",
     "gear 'g1_drive': width_mm must be a number in mm greater than 0 and up to 1000, "
     "found "
     "'20 mm'",
     GM_ERR_FORMAT, NULL},
    {"teeth: 32", "teeth: 3o2", "teeth: 3o2",
     "gear 'g3_drive': teeth must be a whole number from 5 to 1000, found '3o2'",
     GM_ERR_FORMAT, NULL},
    {"y_mm: 0", "y_mm: 3o0", "3o0",
     "shaft 'input_odd': y_mm must be a number in mm from -5000 to 5000, found '3o0'",
     GM_ERR_FORMAT, NULL},
    {"level_mm: -202.8", "level_mm: NaN", "NaN",
     "oil: level_mm must be a number in mm from -5000 to 5000, found 'NaN'",
     GM_ERR_FORMAT, NULL},
    {"volume_l: 1.7", "volume_l: .inf", ".inf",
     "oil: volume_l must be a number in l greater than 0 and up to 1000, found '.inf'",
     GM_ERR_FORMAT, NULL},
    {"volume_l: 1.7", "volume_l: 0x1p1", "0x1p1",
     "oil: volume_l must be a number in l greater than 0 and up to 1000, found '0x1p1'",
     GM_ERR_FORMAT, NULL},
    {"volume_l: 1.7", "volume_l: \"1.7\"", "volume_l",
     "oil: volume_l must be a number in l greater than 0 and up to 1000, found \"1.7\"",
     GM_ERR_FORMAT, NULL},
    {"volume_l: 1.7", "volume_l:", "volume_l",
     "oil: volume_l must be a number in l greater than 0 and up to 1000, found nothing",
     GM_ERR_FORMAT, NULL},
    {"volume_l: 1.7", "volume_l: [1.7]", "volume_l",
     "oil: volume_l must be a number in l greater than 0 and up to 1000, found a list",
     GM_ERR_FORMAT, NULL},
    {"normal_module_mm: 1.75", "normal_module_mm: -1.75", "-1.75",
     "gear 'g1_drive': normal_module_mm must be a number in mm greater than 0 and up to "
     "100, found '-1.75'",
     GM_ERR_FORMAT, NULL},
    {"from_mm: -80, to_mm: -60", "from_mm: 1e400, to_mm: -60", "1e400",
     "shaft 'input_odd', segment 1: from_mm must be a number in mm from -5000 to 5000, "
     "found '1e400'",
     GM_ERR_FORMAT, NULL},
    {"input_torque_max_Nm: 250", "input_torque_max_Nm: 0", "input_torque_max_Nm",
     "limits: input_torque_max_Nm must be a number in N.m greater than 0 and up to "
     "100000, "
     "found '0'",
     GM_ERR_FORMAT, NULL},
    {"format: 1", "format: 2", "format: 2", "format must be the number 1, found '2'",
     GM_ERR_FORMAT, NULL},
    /* words, names, keys */
    {"profile_shift: 0.118954", "profil_shift: 0.118954", "profil_shift",
     "gear 'reverse_idler_in': unknown key 'profil_shift'; did you mean 'profile_shift'?",
     GM_ERR_FORMAT, NULL},
    {"temperature_degC: 80", "temperature: 80", "temperature: 80",
     "oil: unknown key 'temperature'; did you mean 'temperature_degC'?", GM_ERR_FORMAT,
     NULL},
    {"\nseals:", "\nxyzzy: 1\nseals:", "xyzzy", "unknown key 'xyzzy'", GM_ERR_FORMAT,
     NULL},
    {"volume_l: 1.7", "volume_l: 1.7\n  volume_l: 2", "volume_l: 2",
     "the key 'volume_l' stands twice, first in line ", GM_ERR_FORMAT, "volume_l: 1.7"},
    {"bearing: {type: needle_roller, bore_mm: 36, outer_mm: 42, width_mm: 18}",
     "bearing: {type: needle_roler, bore_mm: 36, outer_mm: 42, width_mm: 18}",
     "needle_roler",
     "gear 'g1_driven', bearing: type must be deep_groove_ball, angular_contact_ball, "
     "cylindrical_roller, needle_roller, tapered_roller or plain, found 'needle_roler'; "
     "did you mean 'needle_roller'?",
     GM_ERR_FORMAT, NULL},
    {"name: 75W transmission oil", "name: \"75W\\ttransmission oil\"", "name: \"75W",
     "oil: name must be one line of 1 to 47 bytes, found \"75W transmission oil\"",
     GM_ERR_FORMAT, NULL},
    {"idles: true", "idles: yes", "idles: yes",
     "gear 'g1_driven': idles must be true or false, found 'yes'", GM_ERR_FORMAT, NULL},
    {"g1_drive: {shaft: input_odd", "g1_drive: {shaft: input_od", "input_od,",
     "gear 'g1_drive': shaft must be the name of a shaft, found 'input_od'; did you mean "
     "'input_odd'?",
     GM_ERR_FORMAT, NULL},
    {"gears: [g1_drive, g1_driven]", "gears: [g1_drive, g9_drivel]", "g9_drivel",
     "mesh 'first': gears must be the name of a gear, found 'g9_drivel'; did you "
     "mean 'g1_drive'?",
     GM_ERR_FORMAT, NULL},
    {"gears: [g1_drive, g1_driven]", "gears: [g1_drive]", "first: {gears: [g1_drive]",
     "mesh 'first': gears must be a list of 2 names of gears, found a list",
     GM_ERR_FORMAT, NULL},
    {"  input_even:  ", "  input even:  ", "input even",
     "the name of a shaft must be a letter followed by letters, digits and _, at most "
     "47, "
     "and not housing; found 'input even'",
     GM_ERR_FORMAT, NULL},
    {"      7: {lock", "      7th: {lock", "7th",
     "path 'odd': the number of a gear must be a whole number from -1 to 30, found '7th'",
     GM_ERR_FORMAT, NULL},
    {"cone_torque_Nm: 25,\n           cone_radius_mm: 31, ", "cone_radius_mm: 31, ",
     "sync_6: {",
     "synchroniser 'sync_6': cone_torque_Nm is missing; expected a number in N.m greater "
     "than 0 and up to 100000",
     GM_ERR_FORMAT, NULL},
    {"\noutput: differential", "\n", "format: 1",
     "output is missing; expected the name of a shaft", GM_ERR_FORMAT, NULL},
    {"  input: {shaft: input_even, diameter_mm: 36}", "  input: 36", "  input: 36",
     "seal 'input': expected a group of fields, found '36'", GM_ERR_FORMAT, NULL},
    {"  odd:\n", "  third: {shaft: output_1}\n  odd:\n",
     "\npaths:", "paths has at most 2 entries, found 3", GM_ERR_FORMAT, NULL},
    /* oil and shafts */
    {"viscosity_100_mm2_s: 5.9", "viscosity_100_mm2_s: 5.9\n  third_viscosity_mm2_s: 9.1",
     NULL, "oil: third_viscosity_mm2_s and third_temperature_degC need each other",
     GM_ERR_MODEL, NULL},
    {"viscosity_100_mm2_s: 5.9",
     "viscosity_100_mm2_s: 5.9\n  third_viscosity_mm2_s: 9.1\n"
     "  third_temperature_degC: 98",
     NULL,
     "oil: third_temperature_degC must be at least 5 K from 40 and 100 degC; found 98",
     GM_ERR_MODEL, NULL},
    {"viscosity_100_mm2_s: 5.9",
     "viscosity_100_mm2_s: 5.9\n  third_viscosity_mm2_s: 20\n"
     "  third_temperature_degC: 80",
     NULL,
     "oil: third_viscosity_mm2_s, 20 at 80 degC, lies on no curve by Vogel's equation "
     "through 30.8 at 40 and 5.9 at 100 degC",
     GM_ERR_MODEL, NULL},
    {"viscosity_100_mm2_s: 5.9", "viscosity_100_mm2_s: 59", NULL,
     "oil: viscosity_100_mm2_s must be less than viscosity_40_mm2_s; found 59 and 30.8",
     GM_ERR_MODEL, NULL},
    {"from_mm: -60, to_mm: 166", "from_mm: -50, to_mm: 166", "from_mm: -50",
     "shaft 'input_odd': segment 2: from_mm must be where segment 1 ends; found -50, "
     "expected -60",
     GM_ERR_MODEL, NULL},
    {"diameter_mm: 46, bore_mm: 40", "diameter_mm: 40, bore_mm: 46", "bore_mm: 46",
     "shaft 'reverse_idler': segment 1: bore_mm must be less than diameter_mm; found 46 "
     "and "
     "40",
     GM_ERR_MODEL, NULL},
    {"position_mm: 273", "position_mm: 373", "input_odd_rear",
     "bearing 'input_odd_rear': lies outside its shaft 'input_odd'; found it from 363.5 "
     "to "
     "382.5 mm, expected within -80 to 285 mm",
     GM_ERR_MODEL, NULL},
    {"designation: \"6306\"}", "designation: \"6316\"}", "input_odd_rear",
     "bearing 'input_odd_rear': the catalogue has no bearing \"6316\"; did you mean "
     "\"6306\"?",
     GM_ERR_MODEL, NULL},
    {"designation: \"6306\"}", "designation: \"6306\", bore_mm: 30}", "input_odd_rear",
     "bearing 'input_odd_rear': a bearing has either a designation or dimensions; found "
     "designation '6306' and dimensions",
     GM_ERR_MODEL, NULL},
    {"shaft: output_3, position_mm: 10,", "shaft: output_1, position_mm: 11,",
     "  output_3:  ", "shaft 'output_3': a shaft needs at least 2 bearings, found 1",
     GM_ERR_MODEL, NULL},
    {"position_mm: 128, locating: true", "position_mm: 128", "  output_3:  ",
     "shaft 'output_3': a shaft needs at least 1 locating bearing, found 0", GM_ERR_MODEL,
     NULL},
    {"inner: input_odd, outer: input_even", "inner: input_odd, outer: reverse_idler",
     "outer: reverse_idler",
     "gap 'input': shafts 'input_odd' and 'reverse_idler' must be concentric within "
     "0.020 "
     "mm; found their axes 73.563 mm apart",
     GM_ERR_MODEL, NULL},
    {"on: output_2, position_mm: 88", "on: output_3, position_mm: 88", NULL,
     "bearing 'reverse_idler_rear': shafts 'reverse_idler' and 'output_3' must be "
     "concentric within 0.020 mm; found their axes 84.534 mm apart",
     GM_ERR_MODEL, NULL},
    /* gears */
    {"width_mm: 20, position_mm: 250}", "width_mm: 20, position_mm: 280}", "g1_drive: {",
     "gear 'g1_drive': lies outside its shaft 'input_odd'; found it from 270 to 290 mm, "
     "expected within -80 to 285 mm",
     GM_ERR_MODEL, NULL},
    {"to_mm: 96, diameter_mm: 46, bore_mm: 40", "to_mm: 96, diameter_mm: 56, bore_mm: 50",
     "reverse_idler_out: {",
     "gear 'reverse_idler_out': its root circle must be larger than the bore of its "
     "shaft; "
     "found root diameter 49.208 mm, bore 50 mm",
     GM_ERR_MODEL, NULL},
    {"bore_mm: 36, outer_mm: 42, width_mm: 18}",
     "bore_mm: 30, outer_mm: 35, width_mm: 18}", "g1_driven: {",
     "gear 'g1_driven': its bore must not be smaller than the shaft; found bore 35 mm on "
     "diameter 36 mm",
     GM_ERR_MODEL, NULL},
    {"idles: true,\n              bearing: {type: needle_roller, bore_mm: 36, outer_mm: "
     "42, "
     "width_mm: 18}}",
     "idles: true}", "g1_driven: {", "gear 'g1_driven': an idling gear needs a bearing",
     GM_ERR_MODEL, NULL},
    {"  third: {gears: [g3_drive, g3_driven]}\n", "", "g3_drive: {",
     "gear 'g3_drive': is in no mesh; every gear needs at least 1, found 0", GM_ERR_MODEL,
     NULL},
    {"  z_mm: -76.865594", "  z_mm: -76.365594", "  first: {",
     "mesh 'first': the centre distance from teeth, module, helix and profile shift of "
     "'g1_drive' and 'g1_driven' must be that of shafts 'input_odd' and 'output_1' "
     "within "
     "0.02 mm; found 80.0000 mm from the gears, 79.5197 mm from the shafts",
     GM_ERR_MODEL, NULL},
    {"teeth: 49", "teeth: 50", "  third: {",
     "mesh 'third': the centre distance from teeth, module, helix and profile shift of "
     "'g3_drive' and 'g3_driven' must be that of shafts 'input_odd' and 'output_1' "
     "within "
     "0.02 mm; found 80.9877 mm from the gears, 80.0000 mm from the shafts",
     GM_ERR_MODEL, NULL},
    {"teeth: 46, normal_module_mm: 1.6", "teeth: 46, normal_module_mm: 1.75",
     "  fourth: {",
     "mesh 'fourth': gears that mesh have the same normal module; found 1.6 mm "
     "('g46_drive') and 1.75 mm ('g4_driven')",
     GM_ERR_MODEL, NULL},
    {"teeth: 64, normal_module_mm: 1.75,",
     "teeth: 64, normal_module_mm: 1.75, "
     "pressure_angle_deg: 17.5,",
     "  first: {",
     "mesh 'first': gears that mesh have the same pressure angle; found 20 deg "
     "('g1_drive') and 17.5 deg ('g1_driven')",
     GM_ERR_MODEL, NULL},
    {"helix_deg: -27.632888", "helix_deg: 27.632888", "  first: {",
     "mesh 'first': helix angles must be equal and opposite; found 27.632888 deg "
     "('g1_drive') and 27.632888 deg ('g1_driven')",
     GM_ERR_MODEL, NULL},
    {"width_mm: 16, position_mm: 198}", "width_mm: 16, position_mm: 215}", "  third: {",
     "mesh 'third': gears 'g3_drive' and 'g3_driven' must overlap along x; found their "
     "middles 17 mm apart, expected less than half the sum of their widths, 16 mm",
     GM_ERR_MODEL, NULL},
    {"third: {gears: [g3_drive, g3_driven]}",
     "third: {gears: [g3_drive, g3_driven]}\n  same: {gears: [g1_drive, g3_drive]}",
     "same:",
     "mesh 'same': gears that mesh sit on different shafts; found 'g1_drive' and "
     "'g3_drive' both on 'input_odd'",
     GM_ERR_MODEL, NULL},
    {"third: {gears: [g3_drive, g3_driven]}",
     "third: {gears: [g3_drive, g3_driven]}\n  again: {gears: [g3_driven, g3_drive]}",
     "again:", "mesh 'again': its gears already mesh in 'third', line ", GM_ERR_MODEL,
     "  third: {"},
    {"first: {gears: [g1_drive, g1_driven]",
     "first: {gears: [g1_drive, g1_driven], "
     "loss: {model: constant}",
     "  first: {", "mesh 'first': the loss model constant needs an efficiency",
     GM_ERR_MODEL, NULL},
    /* synchronisers and paths */
    {"sync_24: {shaft: output_1", "sync_24: {shaft: output_2", "sync_24: {",
     "synchroniser 'sync_24': gear 'g2_driven' must be on its shaft 'output_2', found on "
     "'output_1'",
     GM_ERR_MODEL, NULL},
    {"gears: [g6_driven]", "gears: [final_2, g6_driven]", "sync_6: {",
     "synchroniser 'sync_6': gear 'final_2' must idle on its shaft, found it fixed",
     GM_ERR_MODEL, NULL},
    {"gears: [g6_driven]", "gears: [g6_driven, g5_driven]", NULL,
     "synchroniser 'sync_57': gear 'g5_driven' can have 1 synchroniser, found 2",
     GM_ERR_MODEL, NULL},
    {"  sync_24: {shaft: output_1, gears: [g2_driven, g4_driven]",
     "  sync_24: {shaft: output_1, gears: [g2_driven]", "4: {lock",
     "path 'even': gear 4: no synchroniser locks gear 'g4_driven'; expected 1, found 0",
     GM_ERR_MODEL, NULL},
    {"7: {lock: g7_driven", "7: {lock: g7_drive", "7: {lock",
     "path 'odd': gear 7: only an idling gear can be locked; found the fixed gear "
     "'g7_drive'",
     GM_ERR_MODEL, NULL},
    {"7: {lock: g7_driven, ratio: 2.5653}", "0: {lock: g7_driven}", "  odd:\n",
     "path 'odd': its shaft 'input_odd' is connected with the output by what is locked "
     "in neutral; neutral would not be neutral",
     GM_ERR_MODEL, NULL},
    {"7: {lock: g7_driven, ratio: 2.5653}", "0: {lock: g7_driven, ratio: 2}", "0: {lock",
     "path 'odd': gear 0: neutral has no ratio; found one for 'g7_driven'", GM_ERR_MODEL,
     NULL},
    {"7: {lock: g7_driven, ratio: 2.5653}", "7: {lock: g7_driven, ratio: 0}", "7: {lock",
     "path 'odd': gear 7: ratio must not be 0; found 0 for 'g7_driven'", GM_ERR_MODEL,
     NULL},
    {"7: {lock: g7_driven", "+5: {lock: g5_driven", NULL,
     "path 'odd': gear 5: a number stands for one gear; found it twice, here for "
     "'g5_driven'",
     GM_ERR_MODEL, NULL},
    {"6: {lock", "7: {lock", "7: {lock: g6",
     "path 'even': gear 7: a number stands for one gear; path 'odd' has it in line ",
     GM_ERR_MODEL, "7: {lock: g7"},
    {"7: {lock: g7_driven, ratio: 2.5653}", "8: {lock: g6_driven}", "8: {lock",
     "path 'odd': gear 8: no chain of meshes leads from shaft 'input_odd' to the output "
     "'differential'; with gear 'g6_driven' locked to shaft 'output_2', neither of them "
     "meets the input",
     GM_ERR_MODEL, NULL},
    {"  odd:\n", "  odds:\n",
     "  odds:", "path 'odds': two paths are called odd and even; expected the name 'odd'",
     GM_ERR_MODEL, NULL},
    {"\noutput: differential", "\noutput: input_odd", "  odd:\n",
     "path 'odd': its shaft 'input_odd' is connected with the output while nothing is "
     "locked; neutral would not be neutral",
     GM_ERR_MODEL, NULL},
    {"    shaft: input_even\n", "    shaft: input_odd\n", "  even:\n",
     "path 'even': its shaft 'input_odd' is connected with the other path while nothing "
     "is "
     "locked; neutral would not be neutral",
     GM_ERR_MODEL, NULL},
};

static void every_rule_answers_with_its_sentence(void **state)
{
    (void)state;
    char *example = gm_test_slurp(EXAMPLE);
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        gm_test_rule_answers(example, CHANGED, &rules[i]);
    free(example);
}

/* Without final_3 and its mesh, reverse ends on output 3. */
static void a_gear_without_a_way_to_the_output_is_named(void **state)
{
    (void)state;
    char *example = gm_test_slurp(EXAMPLE);
    char *a =
        gm_test_replaced(example, "  final_drive_3: {gears: [final_3, ring]}\n", "");
    char *b = gm_test_replaced(
        a,
        "  final_3: {shaft: output_3, teeth: 17, normal_module_mm: 2.25, "
        "helix_deg: -25,\n            width_mm: 30, position_mm: 40}\n",
        "");
    char expected[GM_ERROR_MESSAGE_SIZE];
    gm_error error = {GM_OK, ""};
    gm_description *d = NULL;
    gm_test_spill(CHANGED, b);
    assert_int_equal(gm_description_read(CHANGED, &d, &error), GM_ERR_MODEL);
    (void)snprintf(
        expected, sizeof expected,
        "%s:%d: path 'even': gear -1: no chain of meshes leads from shaft "
        "'input_even' to the output 'differential'; with gear 'reverse_driven' "
        "locked to shaft 'output_3', neither of them meets the output",
        CHANGED, gm_test_line_of(b, "-1: {lock"));
    assert_string_equal(error.message, expected);
    free(a);
    free(b);
    free(example);
}

/* Cut reverse off at the input: its sleeve hangs on nothing. */
static void a_body_that_no_flange_reaches_is_named(void **state)
{
    (void)state;
    static const char *const cuts[] = {
        "      -1: {lock: reverse_driven, ratio: -17.402} # 4.167 x 4.1765\n",
        "  reverse_1: {gears: [g2_drive, reverse_idler_in]}\n",
        "  reverse_idler_in: {shaft: reverse_idler, teeth: 44, normal_module_mm: 1.95,\n"
        "                     helix_deg: -28.657755, profile_shift: 0.118954,\n"
        "                     width_mm: 16, position_mm: 70}\n"};
    char expected[GM_ERROR_MESSAGE_SIZE];
    gm_error error = {GM_OK, ""};
    gm_description *d = NULL;
    char *text = gm_test_slurp(EXAMPLE);
    for (int i = 0; i < 3; i++) {
        char *next = gm_test_replaced(text, cuts[i], "");
        free(text);
        text = next;
    }
    gm_test_spill(CHANGED, text);
    assert_int_equal(gm_description_read(CHANGED, &d, &error), GM_ERR_MODEL);
    (void)snprintf(
        expected, sizeof expected,
        "%s:%d: shaft 'reverse_idler': no flange reaches it through meshes: its "
        "speed would not be known",
        CHANGED, gm_test_line_of(text, "  reverse_idler:  "));
    assert_string_equal(error.message, expected);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_rule_answers_with_its_sentence),
        cmocka_unit_test(a_gear_without_a_way_to_the_output_is_named),
        cmocka_unit_test(a_body_that_no_flange_reaches_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
