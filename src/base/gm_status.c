/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/gm_status.h"

#include <stdarg.h>
#include <stdio.h>

const char *gm_status_text(gm_status status)
{
    switch (status) {
#define GM_STATUS_CASE(name, text)                                                       \
    case name:                                                                           \
        return text;
        GM_STATUS_LIST(GM_STATUS_CASE)
#undef GM_STATUS_CASE
    }
    return "unknown status";
}

gm_status gm_fail(gm_error *error, gm_status status, const char *format, ...)
{
    if (error) {
        va_list args;
        va_start(args, format);
        error->status = status;
        (void)vsnprintf(error->message, sizeof error->message, format, args);
        va_end(args);
    }
    return status;
}
