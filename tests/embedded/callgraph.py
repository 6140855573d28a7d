# SPDX-License-Identifier: BSD-2-Clause
"""Call graph and stack of compiled C from what gcc -fcallgraph-info=su writes."""

import re

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
FRAME = re.compile(r"(\d+) bytes \((\w+)\)")


def read(files):
    """({function: frame bytes}, {function: called}, functions with a frame that grows)."""
    frames, calls, dynamic = {}, {}, set()
    for file in files:
        text = file.read_text()
        for title, label in NODE.findall(text):
            frame = FRAME.search(label)
            if frame:
                frames[title] = int(frame[1])
                if frame[2] != "static":
                    dynamic.add(title)
        for source, target in EDGE.findall(text):
            calls.setdefault(source, set()).add(target)
    return frames, calls, dynamic


def cycles(calls):
    """Functions that can reach themselves."""
    def reach(start):
        seen, todo = set(), [start]
        while todo:
            for target in calls.get(todo.pop(), ()):
                if target not in seen:
                    seen.add(target)
                    todo.append(target)
        return seen
    return {f for f in calls if f in reach(f)}


def deepest(function, frames, calls):
    """(bytes, chain) of the deepest chain of calls; needs a graph without cycles."""
    below = [deepest(f, frames, calls) for f in sorted(calls.get(function, ()))]
    depth, chain = max(below, default=(0, []))
    return frames.get(function, 0) + depth, [function, *chain]
