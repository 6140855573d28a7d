/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/papers.h"

#include "bake/documentation.h"
#include "bake/package.h"

gm_papers gm_papers_write(const gm_map *map, const gm_bake_summary *summary,
                          const gm_passport *passport)
{
    const bool monotone = summary->interpolation == GM_INTERPOLATION_MONOTONE;
    const gm_document document = {.map = map,
                                  .guid = summary->guid,
                                  .monotone = monotone,
                                  .speed_in = summary->speed_in,
                                  .passport = passport};
    const gm_passport_component component = {.map = map,
                                             .guid = summary->guid,
                                             .interpolation =
                                                 monotone ? "monotone" : "linear",
                                             .library_sha256 = summary->library_sha256};
    gm_papers papers = {{0}, {0}};
    gm_passport_write(passport, &component, &papers.passport);
    gm_documentation_write(&document, &papers.page);
    return papers;
}

gm_status gm_bake_document(const char *path, const gm_map *map,
                           const gm_bake_summary *summary, int n_results,
                           const gm_bake_result *results, gm_error *error)
{
    static const char *const names[] = {GM_PASSPORT, GM_DOCUMENTATION};
    gm_passport passport = {0};
    gm_status status =
        gm_passport_read(n_results, results, map, summary->guid, &passport, error);
    if (status != GM_OK)
        return status;
    gm_papers papers = gm_papers_write(map, summary, &passport);
    gm_buffer *const contents[] = {&papers.passport, &papers.page};
    gm_passport_clear(&passport);
    return gm_package_replace(path, 2, names, contents, error);
}
