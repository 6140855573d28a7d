# SPDX-License-Identifier: BSD-2-Clause
"""The page of `gearmap report`: one file for each thing that it shows.

Data flow one way: sources (map_file, results, gearset) -> chapters (drawing, losses,
proof, limits, origin), which make text and figures -> page, one HTML text.
"""
