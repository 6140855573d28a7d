/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/png.h"

#include <stdint.h>
#include <string.h>

static void put32(gm_buffer *b, uint32_t x)
{
    const unsigned char bytes[4] = {(unsigned char)(x >> 24), (unsigned char)(x >> 16),
                                    (unsigned char)(x >> 8), (unsigned char)x};
    gm_buffer_bytes(b, bytes, 4);
}

/* CRC-32 of ISO 3309, as PNG wants it. */
static uint32_t crc(const char *data, size_t n)
{
    uint32_t c = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        c ^= (unsigned char)data[i];
        for (int bit = 0; bit < 8; bit++)
            c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    }
    return ~c;
}

/* A chunk is its length, then type and data, then their CRC. */
static size_t begin(gm_buffer *b, const char *type, size_t length)
{
    put32(b, (uint32_t)length);
    gm_buffer_bytes(b, type, 4);
    return b->size - (b->failed ? 0 : 4);
}

static void end(gm_buffer *b, size_t from)
{
    if (!b->failed)
        put32(b, crc(b->data + from, b->size - from));
}

static void header(const gm_picture *p, gm_buffer *b)
{
    static const unsigned char kind[5] = {8, 3, 0, 0, 0}; /* 8 bits, palette */
    size_t from = begin(b, "IHDR", 13);
    put32(b, (uint32_t)p->width);
    put32(b, (uint32_t)p->height);
    gm_buffer_bytes(b, kind, sizeof kind);
    end(b, from);
}

static void palette(const gm_picture *p, gm_buffer *b)
{
    size_t from = begin(b, "PLTE", 3 * (size_t)p->n_colours);
    gm_buffer_bytes(b, p->colour, 3 * (size_t)p->n_colours);
    end(b, from);
}

/* Opacities of the colours up to the clear one. */
static void transparency(const gm_picture *p, gm_buffer *b)
{
    static const unsigned char clear = 0, opaque = 255;
    size_t from = begin(b, "tRNS", (size_t)p->clear + 1);
    for (int i = 0; i < p->clear; i++)
        gm_buffer_bytes(b, &opaque, 1);
    gm_buffer_bytes(b, &clear, 1);
    end(b, from);
}

/* Sums of Adler-32. */
static void add(uint32_t sum[2], const unsigned char *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        sum[0] = (sum[0] + bytes[i]) % 65521;
        sum[1] = (sum[1] + sum[0]) % 65521;
    }
}

/* Each line is one stored block: a filter byte (none) and the pixels. */
static void pixels(const gm_picture *p, gm_buffer *b)
{
    const size_t width = (size_t)p->width, line = width + 1;
    uint32_t sum[2] = {1, 0};
    size_t from = begin(b, "IDAT", 2 + (size_t)p->height * (5 + line) + 4);
    gm_buffer_bytes(b, "\x78\x01", 2);
    for (int y = 0; y < p->height; y++) {
        const unsigned char head[6] = {y == p->height - 1,          (unsigned char)line,
                                       (unsigned char)(line >> 8),  (unsigned char)~line,
                                       (unsigned char)(~line >> 8), 0};
        gm_buffer_bytes(b, head, sizeof head);
        gm_buffer_bytes(b, p->pixel + (size_t)y * width, width);
        add(sum, head + 5, 1);
        add(sum, p->pixel + (size_t)y * width, width);
    }
    put32(b, sum[1] << 16 | sum[0]);
    end(b, from);
}

void gm_png_write(const gm_picture *picture, gm_buffer *buffer)
{
    gm_buffer_bytes(buffer, "\x89PNG\r\n\x1a\n", 8);
    header(picture, buffer);
    palette(picture, buffer);
    transparency(picture, buffer);
    pixels(picture, buffer);
    end(buffer, begin(buffer, "IEND", 0));
}
