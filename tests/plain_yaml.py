# SPDX-License-Identifier: BSD-2-Clause
"""The subset of YAML that examples/dct7.yaml uses: read and write, standard library only.

Block mappings and lists, flow mappings and lists on one logical line, plain scalars.
"""
import re


def scalar(text):
    text = text.strip()
    if text[:1] in "\"'" and text:
        return text[1:-1]
    if text in ("true", "false"):
        return text == "true"
    if re.fullmatch(r"[-+]?\d+", text):
        return int(text)
    try:
        return float(text)
    except ValueError:
        return text


class Flow:
    """{a: 1, b: [c, d]}"""

    def __init__(self, text):
        self.tokens = re.findall(r'[{}\[\],:]|"[^"]*"|[^{}\[\],:"\s][^{}\[\],:]*', text)

    def value(self):
        token = self.tokens.pop(0)
        if token == "{":
            return self.mapping()
        if token == "[":
            return self.sequence()
        return scalar(token)

    def mapping(self):
        out = {}
        while self.tokens[0] != "}":
            if self.tokens[0] == ",":
                self.tokens.pop(0)
                continue
            key = self.tokens.pop(0).strip()
            assert self.tokens.pop(0) == ":"
            out[key] = self.value()
        self.tokens.pop(0)
        return out

    def sequence(self):
        out = []
        while self.tokens[0] != "]":
            if self.tokens[0] == ",":
                self.tokens.pop(0)
                continue
            out.append(self.value())
        self.tokens.pop(0)
        return out


def logical_lines(text):
    """(indent, content) without comments; open brackets continue on the next line."""
    out, pending, indent = [], "", 0
    for line in text.splitlines():
        line = re.sub(r"(^|\s)#.*$", "", line).rstrip()
        if not line:
            continue
        if not pending:
            indent = len(line) - len(line.lstrip())
        pending += " " + line.strip()
        if pending.count("{") + pending.count("[") == pending.count("}") + pending.count("]"):
            out.append((indent, pending.strip()))
            pending = ""
    return out


def block(lines, indent):
    if lines and lines[0][1].startswith("- "):
        items = []
        while lines and lines[0][0] == indent and lines[0][1].startswith("- "):
            items.append(Flow(lines.pop(0)[1][2:]).value())
        return items
    out = {}
    while lines and lines[0][0] == indent:
        key, rest = lines.pop(0)[1].split(":", 1)
        rest = rest.strip()
        if rest:
            out[key] = Flow(rest).value() if rest[0] in "{[" else scalar(rest)
        else:
            out[key] = block(lines, lines[0][0])
    return out


def shown(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return "%.9g" % value
    if isinstance(value, str) and not isinstance(scalar(value), str):
        return '"%s"' % value
    if isinstance(value, dict):
        return "{" + ", ".join("%s: %s" % (k, shown(v)) for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(shown(v) for v in value) + "]"
    return str(value)


def dump(data):
    out = []
    for key, value in data.items():
        if not isinstance(value, dict):
            out.append("%s: %s" % (key, shown(value)))
            continue
        out.append("%s:" % key)
        for name, part in value.items():
            if not isinstance(part, dict) or key not in ("shafts", "paths"):
                out.append("  %s: %s" % (name, shown(part)))
                continue
            out.append("  %s:" % name)
            for field, v in part.items():
                if field == "segments":
                    out.append("    segments:")
                    out += ["      - " + shown(s) for s in v]
                elif field == "gears":
                    out.append("    gears:")
                    out += ["      %s: %s" % (n, shown(g)) for n, g in v.items()]
                else:
                    out.append("    %s: %s" % (field, shown(v)))
    return "\n".join(out) + "\n"
