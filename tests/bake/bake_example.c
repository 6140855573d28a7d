/* SPDX-License-Identifier: BSD-2-Clause
 *
 * bake_example SHARE PATHS FILE [FLANGE,...]: bakes the example map, for the tests in
 * Python; the speeds of the flanges are inputs.
 */
#include "example_map.h"

#include "bake/gm_bake.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    gm_bake_summary summary;
    gm_error error;
    if (argc != 4 && argc != 5)
        return 2;
    gm_map *map = example_map(atoi(argv[2]));
    gm_bake_options options = {.share = argv[1], .speed_in = argc == 5 ? argv[4] : NULL};
    gm_status status = gm_bake_fmu2(map, &options, argv[3], &summary, &error);
    gm_map_destroy(map);
    if (status != GM_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("%s %ld %ld\n", summary.guid, summary.file_size, summary.library_size);
    return 0;
}
