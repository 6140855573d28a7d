/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/compile.h"

#include "base/alloc.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static bool is_program(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode) && access(path, X_OK) == 0;
}

/* Full path of a program, searched like a shell does; false when there is none. */
static bool find_program(const char *name, char *path, size_t size)
{
    const char *folders = getenv("PATH");
    if (strchr(name, '/'))
        return snprintf(path, size, "%s", name) < (int)size && is_program(path);
    if (!folders)
        folders = "/usr/local/bin:/usr/bin:/bin";
    while (*folders) {
        size_t n = strcspn(folders, ":");
        if (n > 0 && snprintf(path, size, "%.*s/%s", (int)n, folders, name) < (int)size &&
            is_program(path))
            return true;
        folders += n + (folders[n] == ':');
    }
    return false;
}

/* Text such as "ccache gcc -m64": a program and, after spaces, its arguments. */
static bool use_text(const char *text, gm_compiler *compiler)
{
    char name[512];
    size_t skip = strspn(text, " "), n = strcspn(text + skip, " ");
    return snprintf(name, sizeof name, "%.*s", (int)n, text + skip) < (int)sizeof name &&
           snprintf(compiler->arguments, sizeof compiler->arguments, "%s",
                    text + skip + n) < (int)sizeof compiler->arguments &&
           find_program(name, compiler->path, sizeof compiler->path);
}

static bool find_usual(gm_compiler *compiler)
{
    static const char *const usual[] = {"cc", "gcc", "clang"};
    for (int i = 0; i < 3; i++)
        if (find_program(usual[i], compiler->path, sizeof compiler->path))
            return true;
    return false;
}

gm_status gm_compiler_find(const char *wanted, gm_compiler *compiler, gm_error *error)
{
    gm_compiler found = {.arguments = ""};
    const char *cc = getenv("CC");
    if (wanted) {
        if (!use_text(wanted, &found))
            return gm_fail(error, GM_ERR_TOOL,
                           "the C compiler %s is not an executable program", wanted);
    } else if (cc && cc[strspn(cc, " ")]) {
        if (!use_text(cc, &found))
            return gm_fail(error, GM_ERR_TOOL,
                           "the C compiler %s, named by the environment variable CC, is "
                           "not an executable program",
                           cc);
    } else if (!find_usual(&found)) {
        return gm_fail(error, GM_ERR_TOOL,
                       "a C compiler is needed to build the FMU's library, and none of "
                       "cc, gcc, clang is in the path; install one or name it with CC");
    }
    *compiler = found;
    return GM_OK;
}

/* The same bits everywhere (-ffp-contract=off), only the FMI functions visible, nothing
 * of this machine in the result. */
static const char *const flags[] = {
    "-std=c99",
    "-O3",
    "-ffp-contract=off",
    "-fPIC",
    "-shared",
    "-fvisibility=hidden",
    "-I.",
    "-w",
    "-s",
    "-Wl,--build-id=none",
    "-Wl,--no-undefined",
};
enum { N_FLAGS = sizeof flags / sizeof *flags, MOST_ARGUMENTS = 32 };

/* Over all files at once, which makes a step a fifth faster. Compilers that lack a part
 * for it fail, and are called again without. */
static const char together[] = "-flto";

/* Command line for execv; words is scratch that it points into. extra: one more flag, or
 * NULL. */
static void fill_arguments(const gm_compiler *compiler, const char *extra,
                           const char *map_prefix, char *words, int n,
                           const char *const *sources, const char *output,
                           const char **argument)
{
    int k = 0;
    char *rest = NULL;
    argument[k++] = compiler->path;
    for (char *word = strtok_r(words, " ", &rest); word && k < MOST_ARGUMENTS;
         word = strtok_r(NULL, " ", &rest))
        argument[k++] = word;
    for (int i = 0; i < N_FLAGS; i++)
        argument[k++] = flags[i];
    if (extra)
        argument[k++] = extra;
    argument[k++] = map_prefix;
    argument[k++] = "-o";
    argument[k++] = output;
    for (int i = 0; i < n; i++)
        argument[k++] = sources[i];
    argument[k] = NULL;
}

/* The child: go into the folder, send messages into the pipe, become the compiler. */
static void become(const char **argument, const char *folder, int messages)
{
    int null = open("/dev/null", O_RDONLY);
    if (null >= 0 && chdir(folder) == 0 && dup2(null, 0) >= 0 && dup2(messages, 1) >= 0 &&
        dup2(messages, 2) >= 0) {
        union {
            const char **from;
            char *const *to;
        } vector = {.from = argument}; /* execv does not write into its arguments */
        execv(argument[0], vector.to);
    }
    _exit(127);
}

/* Read what the child says, keep the beginning; the rest is read and dropped. */
static void listen(int messages, char *text, size_t size)
{
    char block[512];
    size_t used = 0;
    ssize_t n;
    while ((n = read(messages, block, sizeof block)) > 0 || (n < 0 && errno == EINTR)) {
        size_t keep = n > 0 ? (size_t)n : 0;
        keep = keep < size - 1 - used ? keep : size - 1 - used;
        memcpy(text + used, block, keep);
        used += keep;
    }
    while (used > 0 && (text[used - 1] == '\n' || text[used - 1] == ' '))
        used--;
    text[used] = '\0';
    for (char *c = text; *c; c++)
        if (*c == '\n' || *c == '\t')
            *c = ' ';
}

/* Start, wait; *code receives the exit code, or 128 + signal. */
static gm_status run(const char **argument, const char *folder, char *text, size_t size,
                     int *code, gm_error *error)
{
    int ends[2], result = 0;
    if (pipe(ends) != 0)
        return gm_fail(error, GM_ERR_TOOL, "%s cannot be started: %s", argument[0],
                       strerror(errno));
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        become(argument, folder, ends[1]);
    }
    close(ends[1]);
    if (child > 0)
        listen(ends[0], text, size);
    close(ends[0]);
    if (child < 0)
        return gm_fail(error, GM_ERR_TOOL, "%s cannot be started: %s", argument[0],
                       strerror(errno));
    while (waitpid(child, &result, 0) < 0 && errno == EINTR)
        ;
    *code = WIFEXITED(result) ? WEXITSTATUS(result) : 128 + WTERMSIG(result);
    return GM_OK;
}

/* Call the compiler once; *code receives its exit code, text what it says. */
static gm_status compile_once(const gm_compiler *compiler, const char *extra,
                              const char *folder, int n, const char *const *sources,
                              const char *output, char *text, size_t size, int *code,
                              gm_error *error)
{
    char words[sizeof compiler->arguments], prefix[4096];
    const char **argument =
        gm_calloc((size_t)(n + N_FLAGS + MOST_ARGUMENTS + 7), sizeof *argument);
    if (!argument)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to call the C compiler");
    snprintf(words, sizeof words, "%s", compiler->arguments);
    snprintf(prefix, sizeof prefix, "-ffile-prefix-map=%s=.", folder);
    fill_arguments(compiler, extra, prefix, words, n, sources, output, argument);
    gm_status status = run(argument, folder, text, size, code, error);
    gm_free(argument);
    return status;
}

gm_status gm_compile(const gm_compiler *compiler, const char *folder, int n,
                     const char *const *sources, const char *output, gm_error *error)
{
    char text[560], library[4608];
    int code = 0;
    snprintf(library, sizeof library, "%s/%s", folder, output);
    gm_status status = compile_once(compiler, together, folder, n, sources, output, text,
                                    sizeof text, &code, error);
    if (status == GM_OK && code != 0 && code < 128) /* 128 + signal: it was ended */
        status = compile_once(compiler, NULL, folder, n, sources, output, text,
                              sizeof text, &code, error);
    if (status != GM_OK)
        return status;
    if (code != 0)
        return gm_fail(error, GM_ERR_TOOL, "the C compiler %s failed with code %d%s%s",
                       compiler->path, code, text[0] ? ": " : " and said nothing", text);
    if (access(library, R_OK) != 0)
        return gm_fail(error, GM_ERR_TOOL,
                       "the C compiler %s reported success but wrote no library",
                       compiler->path);
    return GM_OK;
}
