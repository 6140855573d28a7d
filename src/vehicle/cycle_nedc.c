/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The elementary urban cycle (ECE-15, 195 s, 1018 m) and the extra-urban cycle (EUDC,
 * 400 s, 6955 m) of UN Regulation 83, annex 4a, with the gears of a manual gearbox. Where
 * the regulation opens the clutch to stop, the gear changes when the car stands.
 */
#include "vehicle/cycle_data.h"

/* clang-format off */
const gm_trace_point gm_ece15[GM_ECE15_POINTS] = {
    {0, 0},    {11, 0},   {15, 15},  {23, 15},  {25, 10},  {28, 0},   {49, 0},
    {54, 15},  {56, 15},  {61, 32},  {85, 32},  {93, 10},  {96, 0},   {117, 0},
    {122, 15}, {124, 15}, {133, 35}, {135, 35}, {143, 50}, {155, 50}, {163, 35},
    {176, 35}, {178, 35}, {185, 10}, {188, 0},  {195, 0},
};
const gm_trace_gear gm_ece15_gears[GM_ECE15_GEARS] = {
    {0, 1}, {54, 2}, {97, 1}, {122, 2}, {133, 3}, {176, 2}, {189, 1},
};
const gm_trace_point gm_eudc[GM_EUDC_POINTS] = {
    {0, 0},    {20, 0},   {25, 15},  {27, 15},  {36, 35},  {38, 35},   {46, 50},
    {48, 50},  {61, 70},  {111, 70}, {119, 50}, {188, 50}, {201, 70},  {251, 70},
    {286, 100},{316, 100},{336, 120},{346, 120},{362, 80}, {370, 50},  {380, 0},
    {400, 0},
};
const gm_trace_gear gm_eudc_gears[GM_EUDC_GEARS] = {
    {0, 1},   {25, 2},  {36, 3},  {46, 4},  {61, 5},
    {115, 4}, {201, 5}, {286, 6}, {381, 1},
};
/* clang-format on */
