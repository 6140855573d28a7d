/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_model.h"

#include "gm_tables.h"

const gm_reduced_map *gm_model_map(void)
{
    return &gm_tables_map;
}

const char *gm_model_guid(void)
{
    return GM_TABLES_GUID;
}

const char *gm_model_path_name(int p)
{
    return gm_tables_path_names[p];
}
