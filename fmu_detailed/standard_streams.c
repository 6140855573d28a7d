/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The static library that reads YAML is made for programs: it addresses stdin, stdout and
 * stderr directly, which a shared library cannot. The build gives these three other names
 * in its copy (CMakeLists.txt); here are the variables of these names.
 */
#include "standard_streams.h"

FILE *gm_stream_stdin, *gm_stream_stdout, *gm_stream_stderr;

__attribute__((constructor)) static void set_streams(void)
{
    gm_stream_stdin = stdin;
    gm_stream_stdout = stdout;
    gm_stream_stderr = stderr;
}
