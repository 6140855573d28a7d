/* SPDX-License-Identifier: BSD-2-Clause */
#include "verified.h"

#include "base/alloc.h"

#include <stdlib.h>
#include <string.h>

static void copy(char *text, size_t size, const char *from)
{
    (void)snprintf(text, size, "%s", from ? from : "");
}

gm_status gm_measured_read(const gm_fmu *fmu, const gm_gearset_file *file,
                           gm_measured *measured, gm_error *error)
{
    const gm_fmu_origin origin = gm_fmu_read_origin(fmu);
    gm_measured m;
    copy(m.description_sha256, sizeof m.description_sha256,
         file->plant->info.source_sha256);
    copy(m.made_from_sha256, sizeof m.made_from_sha256, origin.description_sha256);
    copy(m.map_hash, sizeof m.map_hash, origin.map_hash);
    copy(m.guid, sizeof m.guid, origin.guid);
    gm_status status = gm_fmu_hash_library(fmu, m.library_sha256, error);
    if (status == GM_OK)
        *measured = m;
    return status;
}

bool gm_measured_same(const gm_measured *measured)
{
    return strcmp(measured->made_from_sha256, measured->description_sha256) == 0;
}

static const char *or_null(const char *text)
{
    return *text ? text : NULL;
}

static void measured_json(const gm_measured *m, gm_json *json)
{
    gm_json_object(json, "measured");
    gm_json_text(json, "tool_version", GM_VERSION);
    gm_json_text(json, "description_sha256", m->description_sha256);
    gm_json_text(json, "map_hash", or_null(m->map_hash));
    gm_json_text(json, "fmu_guid", or_null(m->guid));
    gm_json_text(json, "fmu_binary_sha256", m->library_sha256);
    gm_json_end(json);
}

void gm_verified_json(const gm_verified *verified, gm_json *json)
{
    gm_json_bool(json, "same_description", gm_measured_same(&verified->measured));
    measured_json(&verified->measured, json);
    if (verified->steady)
        gm_verify_stage_json(verified->steady, json);
    if (verified->cycle)
        gm_cycle_stage_json(verified->cycle, json);
}

gm_status gm_verified_text(const gm_verified *verified, char **text, gm_error *error)
{
    char *written = NULL, *kept = NULL;
    size_t size = 0;
    gm_json json;
    FILE *out = open_memstream(&written, &size);
    if (out) {
        gm_json_start(&json, out);
        gm_verified_json(verified, &json);
        gm_json_finish(&json);
        int bad = ferror(out);
        if (fclose(out) == 0 && !bad)
            kept = gm_strdup(written);
    }
    free(written); /* open_memstream's own */
    if (!kept)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the result");
    *text = kept;
    return GM_OK;
}
