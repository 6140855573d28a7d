# SPDX-License-Identifier: BSD-2-Clause
"""What lies beside description and library in the FMU: page, licence, picture, map."""

import re
import sqlite3
import struct
import zipfile
import zlib
from html.parser import HTMLParser

import pytest


@pytest.fixture(params=["one", "two"])
def baked(request):
    return request.getfixturevalue(request.param)


class Page(HTMLParser):
    """Text, links, and whether every element is closed where it should be."""

    VOID = {"meta", "img"}

    def __init__(self, text):
        super().__init__()
        self.open, self.words, self.links, self.ids = [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag not in self.VOID:
            self.open.append(tag)
        self.links += [v for k, v in attributes if k in ("href", "src")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "style" not in self.open:
            self.words.append(data)


def page_of(baked):
    return (baked.folder / "documentation/index.html").read_text(encoding="utf-8")


def test_the_page_is_closed_and_its_links_lead_somewhere(baked):
    text = page_of(baked)
    assert text.startswith("<!DOCTYPE html>\n<html lang=")
    page = Page(text)
    assert page.open == []
    assert sorted(page.links) == ["../model.png", "licenses/license.txt"]
    for link in page.links:
        assert (baked.folder / "documentation" / link).is_file()
    assert "://" not in text  # nothing is loaded from elsewhere


def test_the_page_tells_what_the_description_tells(baked):
    words = " ".join("".join(Page(page_of(baked)).words).split())
    for v in baked.description.modelVariables:
        assert v.name in words and v.description in words
    assert baked.description.guid in words
    assert baked.description.generationTool in words
    assert baked.description.version in words  # the map's content hash
    assert "Not measured" in words


def chunks(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        crc, = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        assert zlib.crc32(kind + body) == crc
        yield kind, body
        at += 12 + length
    assert at == len(data)


def test_the_picture_is_a_png_with_a_field_for_every_gear(baked):
    parts = list(chunks((baked.folder / "model.png").read_bytes()))
    assert [kind for kind, _ in parts] == [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"]
    width, height, depth, colour = struct.unpack(">IIBB", parts[0][1][:10])
    assert (depth, colour) == (8, 3)
    lines = zlib.decompress(parts[3][1])  # checks the sum too
    assert len(lines) == height * (width + 1)
    rows = [lines[y * (width + 1):(y + 1) * (width + 1)] for y in range(height)]
    assert all(row[0] == 0 for row in rows)
    clear = len(parts[2][1]) - 1
    used = {p for row in rows for p in row[1:]}
    assert clear in used and max(used) < len(parts[1][1]) // 3
    gears = sum(len(re.findall(rf"<td>{p}</td><td class=\"n\">-?\d", page_of(baked)))
                for p in {n.split(".")[0] for n in baked.variables if n.endswith(".gear")})
    fields = sum(row[1 + x] != clear and row[x] == clear and rows[y - 1][1 + x] == clear
                 for y, row in enumerate(rows[1:], 1) for x in range(1, width))
    assert fields == gears > 0


def test_the_map_is_the_one_it_was_baked_from(baked):
    file, = (baked.folder / "extra/gearmap").glob("*.map")
    with sqlite3.connect(file) as db:
        meta = dict(db.execute("SELECT key, value FROM meta"))
        assert db.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    assert meta["state"] == "finished"
    assert meta["content_hash"] == baked.description.version


def test_the_licence_is_where_the_standard_looks(baked):
    text = (baked.folder / "documentation/licenses/license.txt").read_text()
    assert text.startswith("BSD 2-Clause License") or "Redistribution" in text


def test_entries_are_sorted_and_have_no_date_of_their_own(baked):
    entries = zipfile.ZipFile(baked.file).infolist()
    assert [e.filename for e in entries] == sorted(e.filename for e in entries)
    assert {e.date_time for e in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert not any("\\" in e.filename or e.extra for e in entries)
