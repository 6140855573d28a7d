/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_NUMBER 63
#define MAX_WORD 63

static const char *skip_digits(const char *s)
{
    while (*s >= '0' && *s <= '9')
        s++;
    return s;
}

/* Length of the decimal number at the start of text, 0 if there is none. */
static size_t decimal_length(const char *text)
{
    const char *s = text + (*text == '-' || *text == '+');
    const char *whole = s;
    s = skip_digits(s);
    int digits = (int)(s - whole);
    if (*s == '.') {
        const char *fraction = ++s;
        s = skip_digits(s);
        digits += (int)(s - fraction);
    }
    if (digits == 0)
        return 0;
    if (*s == 'e' || *s == 'E') {
        const char *exponent = s + 1 + (s[1] == '-' || s[1] == '+');
        const char *end = skip_digits(exponent);
        if (end > exponent)
            s = end;
    }
    return (size_t)(s - text);
}

/* The library never calls setlocale, but a host program may have: go through '.' only. */
static bool convert(const char *text, size_t length, double *value)
{
    char number[MAX_NUMBER + 1];
    if (length == 0 || length > MAX_NUMBER)
        return false;
    memcpy(number, text, length);
    number[length] = '\0';
    char *end = NULL;
    double v = strtod(number, &end);
    if (end != number + length || !isfinite(v))
        return false;
    *value = v;
    return true;
}

bool gm_text_to_double(const char *text, double *value)
{
    size_t length = decimal_length(text);
    return text[length] == '\0' && convert(text, length, value);
}

bool gm_text_to_int(const char *text, int *value)
{
    const char *digits = text + (*text == '-' || *text == '+');
    if (*digits == '\0' || *skip_digits(digits) != '\0')
        return false;
    errno = 0;
    long v = strtol(text, NULL, 10);
    if (errno != 0 || v > INT_MAX || v < INT_MIN)
        return false;
    *value = (int)v;
    return true;
}

bool gm_text_to_quantity(const char *text, const char *unit, double *value)
{
    size_t length = decimal_length(text);
    const char *rest = text + length;
    while (*rest == ' ')
        rest++;
    bool fits = *rest == '\0' ? text[length] == '\0' : strcmp(rest, unit) == 0;
    return fits && convert(text, length, value);
}

static bool is_continued(const unsigned char *s, int extra)
{
    for (int i = 1; i <= extra; i++)
        if ((s[i] & 0xC0u) != 0x80u)
            return false;
    return true;
}

size_t gm_text_utf8_length(const char *text, size_t left)
{
    static const unsigned char low[] = {0xC2, 0xE0, 0xF0}, high[] = {0xDF, 0xEF, 0xF4};
    const unsigned char *s = (const unsigned char *)text;
    if (left > 0 && s[0] < 0x80)
        return 1;
    for (int extra = 1; extra <= 3 && (size_t)extra < left; extra++) {
        if (s[0] < low[extra - 1] || s[0] > high[extra - 1])
            continue;
        bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
        bool surrogate = s[0] == 0xED && s[1] > 0x9F;
        bool too_large = s[0] == 0xF4 && s[1] > 0x8F;
        bool wrong = overlong || surrogate || too_large || !is_continued(s, extra);
        return wrong ? 0 : (size_t)extra + 1;
    }
    return 0;
}

static int min3(int a, int b, int c)
{
    int m = a < b ? a : b;
    return m < c ? m : c;
}

/* Levenshtein distance; words longer than MAX_WORD are far from everything. */
static int edit_distance(const char *a, const char *b)
{
    size_t n_a = strlen(a), n_b = strlen(b);
    int row[MAX_WORD + 1];
    if (n_a > MAX_WORD || n_b > MAX_WORD)
        return INT_MAX;
    for (size_t j = 0; j <= n_b; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= n_a; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= n_b; j++) {
            int same =
                tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            int next = min3(row[j] + 1, row[j - 1] + 1, diagonal + !same);
            diagonal = row[j];
            row[j] = next;
        }
    }
    return row[n_b];
}

int gm_text_nearest(const char *word, const char *const *candidates, int n)
{
    int best = -1, best_distance = INT_MAX;
    for (int i = 0; i < n; i++) {
        int distance = edit_distance(word, candidates[i]);
        if (distance < best_distance) {
            best_distance = distance;
            best = i;
        }
    }
    int limit = 1 + (int)strlen(word) / 3;
    return best_distance <= limit ? best : -1;
}
