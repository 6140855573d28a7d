/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Status codes of the whole library, and the one place for error texts.
 * Every function that can fail returns gm_status; the sentence for the user goes
 * into a gm_error that the caller may pass (NULL: not wanted).
 */
#ifndef GM_STATUS_H
#define GM_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* name, text */
#define GM_STATUS_LIST(X)                                                                \
    X(GM_OK, "ok")                                                                       \
    X(GM_ERR_MEMORY, "out of memory")                                                    \
    X(GM_ERR_IO, "a file could not be read or written")                                  \
    X(GM_ERR_FORMAT, "a file does not have the expected form")                           \
    X(GM_ERR_MODEL, "the gearset breaks a rule")                                         \
    X(GM_ERR_ARGUMENT, "an argument is out of its range")                                \
    X(GM_ERR_SOLVE, "the equations could not be solved")                                 \
    X(GM_ERR_TOOL, "a program or library that is needed failed or is missing")           \
    X(GM_ERR_INTERRUPTED, "interrupted")

typedef enum gm_status {
#define GM_STATUS_ENUM(name, text) name,
    GM_STATUS_LIST(GM_STATUS_ENUM)
#undef GM_STATUS_ENUM
} gm_status;

#if defined(__GNUC__)
#define GM_NODISCARD __attribute__((warn_unused_result))
#define GM_PRINTF(format_index, first)                                                   \
    __attribute__((format(printf, format_index, first)))
#else
#define GM_NODISCARD
#define GM_PRINTF(format_index, first)
#endif

#define GM_ERROR_MESSAGE_SIZE 768

/** One sentence for the user; message is empty while status is GM_OK. */
typedef struct gm_error {
    gm_status status;
    char message[GM_ERROR_MESSAGE_SIZE];
} gm_error;

/** Text of a status; never NULL. */
const char *gm_status_text(gm_status status);

/** Fill *error (may be NULL) with a formatted sentence and return status.
 *  Usage: return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path, why); */
GM_PRINTF(3, 4)
gm_status gm_fail(gm_error *error, gm_status status, const char *format, ...);

#ifdef __cplusplus
}
#endif
#endif
